/* Compares equipod_drives.c with numbers of the library: bit for bit in double where the design has no lead, within some roundings otherwise.
 *
 *     cc -std=c99 -ffp-contract=off equipod.c equipod_drives.c equipod_design.c equipod_selftest.c -lm -o selftest && ./selftest
 *
 * Exit status 0: all agree. */
#include "equipod_design.h"
#include "equipod_drives.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define R(x) ((real_t)(x))
#ifdef EQUIPOD_FLOAT
#define EPSILON ((double)FLT_EPSILON)
#else
#define EPSILON DBL_EPSILON
#endif
/* Roundings allowed to lengths, over the size of the design; to rates; to tracked poses, over their condition. */
#define LENGTHS (256 * EPSILON)
#define RATES (4096 * EPSILON)
#define POSES (8192 * EPSILON)

typedef struct {
    double rotation[3][3];
    double position[3];
} pose_numbers;

/* Drives at a pose; or the leg from 1 that has no length. */
typedef struct {
    pose_numbers pose;
    double lengths[6];
    int missing;
    double corrections[6], of_offsets[6], twists[6], lines[6][3], rates[6][6];
} drive_vector;

/* A pose followed from one to other lengths, and the bound of its error where it is proved. */
typedef struct {
    pose_numbers start;
    double lengths[6];
    unsigned segments;
    int status;
    pose_numbers pose;
    double distances[6], frobenius_ratio, factor;
    unsigned steps;
    int proved;
    double position, angle, contraction;
} follow_vector;

#include "equipod_vectors.h"

#define COUNT(list) (sizeof(list) / sizeof(*(list)))

static unsigned checks, failures, told, proofs;

static void check(int good, const char *what, unsigned number)
{
    checks += 1;
    if (!good) {
        failures += 1;
        if (told < 20) {
            told += 1;
            printf("differs: %s, vector %u\n", what, number);
        }
    }
}

static equipod_pose pose_from(const pose_numbers *numbers)
{
    equipod_pose pose;
    int i, k;
    for (i = 0; i < 3; i += 1) {
        for (k = 0; k < 3; k += 1) {
            pose.rotation[i][k] = R(numbers->rotation[i][k]);
        }
        pose.position[i] = R(numbers->position[i]);
    }
    return pose;
}

/* The arc tangent of a screw is that of the mathematical library; everything else is arithmetic. */
static int same(const real_t *ours, const double *theirs, int count, double tolerance)
{
    int i, all = 1;
    for (i = 0; i < count; i += 1) {
#ifndef EQUIPOD_FLOAT
        if (equipod_design_drives.lead == R(0)) {
            all = all && memcmp(&ours[i], &theirs[i], sizeof ours[i]) == 0;
            continue;
        }
#endif
        all = all && fabs((double)ours[i] - theirs[i]) <= tolerance;
    }
    return all;
}

static void drive(const drive_vector *v, unsigned number)
{
    const equipod_pose pose = pose_from(&v->pose);
    const double size = (double)equipod_design_drives.size;
    equipod_drive_state state;
    real_t lengths[6];
    const int missing = equipod_drive_states(&equipod_design_drives, &equipod_nominal, &pose, &state);
    check(missing == v->missing, "the leg without a length", number);
    if (missing || v->missing) {
        return;
    }
    check(equipod_drive_lengths(&equipod_design_drives, &equipod_nominal, &pose, lengths) == 0, "all have lengths", number);
    check(same(lengths, v->lengths, 6, LENGTHS * size), "lengths", number);
    check(same(state.correction, v->corrections, 6, LENGTHS * size), "corrections", number);
    check(same(state.of_offsets, v->of_offsets, 6, LENGTHS * size), "corrections of offsets", number);
    check(same(state.twist, v->twists, 6, RATES), "twists", number);
    check(same(&state.line[0][0], &v->lines[0][0], 18, LENGTHS * size), "lines", number);
    check(same(&state.rates[0][0], &v->rates[0][0], 36, RATES * fmax(1, size)), "rates", number);
}

static void follow(const follow_vector *v, unsigned number)
{
    const equipod_pose start = pose_from(&v->start);
    const double tolerance = POSES / fmax(1e-3, v->frobenius_ratio), size = (double)equipod_design_drives.size;
    equipod_drive_result found;
    equipod_drive_bound bound;
    real_t lengths[6];
    int i, proved;
    for (i = 0; i < 6; i += 1) {
        lengths[i] = R(v->lengths[i]);
    }
    (void)equipod_track_drives(&equipod_design_drives, &equipod_nominal, lengths, &start, R(EQUIPOD_SINGULAR), v->segments, &found);
    check((int)found.status == v->status, "the status", number);
    if (v->status != (int)EQUIPOD_DRIVES_REACHED || found.status != EQUIPOD_DRIVES_REACHED) {
        return;
    }
    check(same(found.near.pose.position, v->pose.position, 3, tolerance * size), "a tracked position", number);
    check(same(&found.near.pose.rotation[0][0], &v->pose.rotation[0][0], 9, tolerance), "a tracked rotation", number);
    check(same(found.distances, v->distances, 6, tolerance * size), "distances", number);
#ifndef EQUIPOD_FLOAT
    if (equipod_design_drives.lead == R(0)) {
        check(found.steps == v->steps && same(&found.factor, &v->factor, 1, 0), "steps and factor", number);
    }
#endif
    proved = equipod_bound_drives(&equipod_design_drives, &equipod_nominal, &equipod_home, &found.near.pose, lengths, &bound);
    proofs += proved != 0;
#ifndef EQUIPOD_FLOAT
    check(proved == v->proved, "a proof", number);
    if (proved && v->proved) {
        /* another approximate inverse: eta is rounding, of which some hundredths are noise */
        check((double)bound.position <= 2 * v->position && v->position <= 2 * (double)bound.position, "a bound of the position", number);
        check((double)bound.angle <= 2 * v->angle && v->angle <= 2 * (double)bound.angle, "a bound of the angle", number);
        check(bound.contraction < 1, "a contraction", number);
    }
    if (proved) {
        /* a pose beside the right one: its bound reaches to it */
        equipod_pose beside = found.near.pose;
        const double off = 1e-7 * size;
        beside.position[0] += R(off);
        if (equipod_bound_drives(&equipod_design_drives, &equipod_nominal, &equipod_home, &beside, lengths, &bound)) {
            check((double)bound.position >= off * (1 - 1e-6), "a bound of a pose beside", number);
        }
    }
#endif
}

int main(void)
{
    unsigned k;
    for (k = 0; k < COUNT(drive_vectors); k += 1) {
        drive(&drive_vectors[k], k);
    }
    for (k = 0; k < COUNT(follow_vectors); k += 1) {
        follow(&follow_vectors[k], k);
    }
    /* lengths that are none, and numbers that are none, lead to no pose */
    if (COUNT(follow_vectors) > 0) {
        const equipod_pose start = pose_from(&follow_vectors[0].start);
        real_t lengths[6];
        equipod_drive_result found;
        int i;
        for (i = 0; i < 6; i += 1) {
            lengths[i] = R(follow_vectors[0].lengths[i]);
        }
        lengths[3] = R(NAN);
        check(equipod_track_drives(&equipod_design_drives, &equipod_nominal, lengths, &start, R(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS, &found) ==
                  EQUIPOD_DRIVES_NOT_TRACKED,
              "lengths that are no numbers", 0);
        lengths[3] = -equipod_design_drives.size;
        check(equipod_track_drives(&equipod_design_drives, &equipod_nominal, lengths, &start, R(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS, &found) ==
                  EQUIPOD_DRIVES_NOT_TRACKED,
              "a length below zero", 0);
    }
    printf("%u checks, %u failed, %u of %u poses proved\n", checks, failures, proofs, (unsigned)COUNT(follow_vectors));
    return failures != 0;
}

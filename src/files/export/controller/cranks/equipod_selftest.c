/* Compares equipod_cranks.c with numbers of the library, within some roundings.
 *
 *     cc -std=c99 -ffp-contract=off equipod.c equipod_cranks.c equipod_design.c equipod_selftest.c -lm -o selftest && ./selftest
 *
 * Exit status 0: all agree. */
#include "equipod_cranks.h"
#include "equipod_design.h"

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
/* Roundings allowed to angles, over the cosine of the angle between crank and rod; to tracked poses, over their condition. */
#define ANGLES (256 * EPSILON)
#define POSES (4096 * EPSILON)

typedef struct {
    double rotation[3][3];
    double position[3];
} pose_numbers;

/* Angles at a pose, with the Jacobian; or the leg from 1 that does not reach. */
typedef struct {
    pose_numbers pose;
    int missing;
    double kept[6], other[6], transmissions[6], jacobian[6][6];
} angle_vector;

/* A pose followed from angles to angles. */
typedef struct {
    pose_numbers start;
    double from[6], to[6];
    int status;
    pose_numbers pose;
    double frobenius_ratio;
} step_vector;

#include "equipod_vectors.h"

#define COUNT(list) (sizeof(list) / sizeof(*(list)))

static unsigned checks, failures, told;

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

static void angles(const angle_vector *v, unsigned number)
{
    const equipod_pose pose = pose_from(&v->pose);
    real_t kept[6], other[6], transmissions[6], j[6][6];
    int i, k;
    const int missing = equipod_crank_angles(&equipod_design_cranks, &pose, kept, other);
    check(missing == v->missing, "the leg that does not reach", number);
    if (missing || v->missing) {
        return;
    }
    equipod_crank_transmissions(&equipod_design_cranks, &pose, kept, transmissions);
    check(equipod_crank_jacobian(&equipod_design_cranks, &pose, kept, j), "regular cranks", number);
    for (i = 0; i < 6; i += 1) {
        const double tolerance = ANGLES / fabs(v->transmissions[i]);
        double row = 0;
        check(fabs((double)kept[i] - v->kept[i]) <= tolerance, "an angle", number);
        check(fabs((double)other[i] - v->other[i]) <= tolerance, "an angle of the other side", number);
        check(fabs((double)transmissions[i] - v->transmissions[i]) <= tolerance, "a transmission", number);
        for (k = 0; k < 6; k += 1) {
            row = fmax(row, fabs(v->jacobian[i][k]));
        }
        for (k = 0; k < 6; k += 1) {
            check(fabs((double)j[i][k] - v->jacobian[i][k]) <= row * tolerance / fabs(v->transmissions[i]), "the Jacobian", number);
        }
    }
}

static void step(const step_vector *v, unsigned number)
{
    const equipod_pose start = pose_from(&v->start);
    real_t from[6], to[6];
    equipod_result found;
    const double tolerance = POSES / v->frobenius_ratio;
    int i, k;
    for (i = 0; i < 6; i += 1) {
        from[i] = R(v->from[i]);
        to[i] = R(v->to[i]);
    }
    (void)equipod_track_cranks(&equipod_design_cranks, from, to, &start, R(EQUIPOD_SINGULAR), EQUIPOD_CRANK_PARTS, EQUIPOD_SEGMENTS, &found);
    check((int)found.status == v->status, "the status", number);
    if (v->status != EQUIPOD_TRACKED || found.status != EQUIPOD_TRACKED) {
        return;
    }
    for (i = 0; i < 3; i += 1) {
        check(fabs((double)found.pose.position[i] - v->pose.position[i]) <= tolerance * EQUIPOD_DESIGN_SIZE, "a tracked position", number);
        for (k = 0; k < 3; k += 1) {
            check(fabs((double)found.pose.rotation[i][k] - v->pose.rotation[i][k]) <= tolerance, "a tracked rotation", number);
        }
    }
}

int main(void)
{
    unsigned k;
    for (k = 0; k < COUNT(angle_vectors); k += 1) {
        angles(&angle_vectors[k], k);
    }
    for (k = 0; k < COUNT(step_vectors); k += 1) {
        step(&step_vectors[k], k);
    }
    /* angles too far apart for the parts allowed, and angles that are no numbers, are said to be lost */
    if (COUNT(step_vectors) > 0) {
        const equipod_pose start = pose_from(&step_vectors[0].start);
        real_t from[6], to[6];
        equipod_result found, beside;
        int i;
        for (i = 0; i < 6; i += 1) {
            from[i] = R(step_vectors[0].from[i]);
            to[i] = from[i] + R(1);
        }
        check(equipod_track_cranks(&equipod_design_cranks, from, to, &start, R(EQUIPOD_SINGULAR), 2u, EQUIPOD_SEGMENTS, &found) == EQUIPOD_LOST, "far angles", 0);
        to[2] = R(NAN);
        check(equipod_track_cranks(&equipod_design_cranks, from, to, &start, R(EQUIPOD_SINGULAR), EQUIPOD_CRANK_PARTS, EQUIPOD_SEGMENTS, &found) == EQUIPOD_LOST,
              "angles that are no numbers", 0);
        check(found.position_error > R(1e30), "the bound of no pose", 0);
        for (i = 0; i < 6; i += 1) {
            to[i] = from[i] + R(0.001) * (real_t)(i % 2);
        }
        (void)equipod_track_cranks(&equipod_design_cranks, from, to, &start, R(EQUIPOD_SINGULAR), EQUIPOD_CRANK_PARTS, EQUIPOD_SEGMENTS, &beside);
        found.pose = start;
        (void)equipod_track_cranks(&equipod_design_cranks, from, to, &found.pose, R(EQUIPOD_SINGULAR), EQUIPOD_CRANK_PARTS, EQUIPOD_SEGMENTS, &found);
        check(found.status == beside.status && memcmp(&found.pose, &beside.pose, sizeof found.pose) == 0, "a start in the place of the result", 0);
    }
    printf("%u checks, %u failed\n", checks, failures);
    return failures != 0;
}

/* A pose by the octahedral platform is called tracked only where the joints as measured prove it. Exit 0: all is as claimed. */
#include "equipod.h"
#include "equipod_design.h"

#include <math.h>

#include "check.h"

#define CASES 60u
/* Joints that are far off need many cases to tell a pose that continues the start from one that does not. */
#ifndef MANY
#define MANY 3000u
#endif
#define SEGMENTS 1000u

static double apart(const equipod_pose *a, const equipod_pose *b)
{
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        sum += (a->position[k] - b->position[k]) * (a->position[k] - b->position[k]);
    }
    return sqrt(sum);
}

static equipod_status track(const equipod_legs *measured, const double s[6], const equipod_pose *start, equipod_result *r)
{
    return equipod_track_mapped(&equipod_to_octahedral, &equipod_octahedral, measured, s, start, EQUIPOD_SINGULAR, EQUIPOD_SEGMENTS, 3, r);
}

/* Joints off by up to `error`: what is tracked has the lengths, a bound, and is the pose that tracking on these joints alone finds. */
static void measured_off_by(double error, unsigned cases, unsigned *tracked)
{
    unsigned n;
    for (n = 0; n < cases; n++) {
        double base[6][3], platform[6][3], s[6], own[6], off = 0;
        equipod_legs measured;
        equipod_result r, alone;
        int i, k;
        for (i = 0; i < 6; i++) {
            for (k = 0; k < 3; k++) {
                base[i][k] = equipod_nominal.base[i][k] + error * any();
                platform[i][k] = equipod_nominal.platform[i][k] + error * any();
            }
        }
        check(equipod_prepare((const double(*)[3])base, (const double(*)[3])platform, &measured), "joints", n);
        equipod_squared_lengths(&equipod_nominal, &equipod_home, s);
        if (track(&measured, s, &equipod_home, &r) != EQUIPOD_TRACKED) {
            continue;
        }
        *tracked += 1;
        equipod_squared_lengths(&measured, &r.pose, own);
        for (i = 0; i < 6; i++) {
            off = fmax(off, fabs(own[i] - s[i]) / s[i]);
        }
        check(off < 1e-10 && r.residual < 1e-9, "the lengths of a tracked pose", n);
        check(r.position_error < 1e-3 * equipod_nominal.unit, "the bound of a tracked pose", n);
        (void)equipod_track(&measured, s, 0, &equipod_home, EQUIPOD_SINGULAR, SEGMENTS, &alone);
        check(alone.status == EQUIPOD_TRACKED && apart(&alone.pose, &r.pose) <= r.position_error + 1e-9 * equipod_nominal.unit,
              "the pose that the joints alone have", n);
    }
}

/* The start may be the pose of the result. */
static void in_place(void)
{
    equipod_result r, other;
    double s[6];
    int i;
    equipod_squared_lengths(&equipod_nominal, &equipod_home, s);
    for (i = 0; i < 6; i++) {
        s[i] *= 1 + 0.002 * any();
    }
    r.pose = equipod_home;
    check(track(&equipod_nominal, s, &equipod_home, &other) == EQUIPOD_TRACKED, "a small way", 0);
    check(track(&equipod_nominal, s, &r.pose, &r) == EQUIPOD_TRACKED, "a small way in place", 0);
    check(r.distance == other.distance && r.distance > 0 && apart(&r.pose, &other.pose) == 0, "in place and beside are one", 0);
    r.pose.rotation[1][1] = NAN;
    check(track(&equipod_nominal, s, &r.pose, &r) == EQUIPOD_LOST && isinf(r.position_error), "a start that is no pose", 0);
}

int main(void)
{
    const double errors[6] = {0, 1e-5, 1e-3, 1e-2, 0.1, 0.3};
    unsigned tracked[6] = {0, 0, 0, 0, 0, 0};
    int n;
    for (n = 0; n < 6; n++) {
        measured_off_by(errors[n] * equipod_nominal.unit, n < 5 ? CASES : MANY, &tracked[n]);
    }
    /* joints that are nearly those of the design are no reason to give up */
    check(tracked[0] == CASES && tracked[1] == CASES && tracked[2] == CASES, "measured joints near those of the design", 0);
    in_place();
    printf("tracked: %u %u %u %u %u %u; %u failed\n", tracked[0], tracked[1], tracked[2], tracked[3], tracked[4], tracked[5], failures);
    return failures != 0;
}

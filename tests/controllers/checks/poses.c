/* Poses become joint values and the same poses again, by the code of the kinematics modules for LinuxCNC: with tools, with joints as
 * measured, with turning screws, and with the octahedral platform where there is one. Exit 0: every pose came back within its bound. */
#include <math.h>
#include <kinematics.h>

#include "equipodkins.h"

#include "check.h"

#ifndef CASES
#define CASES 40u
#endif
/* Below this ratio a pose may be lost: where joints are not ideal the fixed point leaves it sooner. */
#ifdef EQUIPOD_HAS_DRIVES
#define LOST_BELOW 1e-2
#else
#define LOST_BELOW 1e-4
#endif

static machine_t machine;
static double size; /* millimetres */

/* The machine of a test: joints off by up to `error`, a tool, screws, and legs that show other lengths than they have. */
static void made(double error, double tool, double lead, int octahedral)
{
    int i, k;
    as_designed(&machine);
    for (i = 0; i < LEGS; i++) {
        for (k = 0; k < 3; k++) {
            machine.base[i][k] += error * any();
            machine.platform[i][k] += error * any();
        }
    }
    for (i = 0; i < LEGS; i++) {
        machine.leg_offset[i] = 0.2 * size * any();
    }
    machine.tool = tool;
#ifdef EQUIPOD_HAS_DRIVES
    (void)lead;
    (void)octahedral;
#else
    machine.screw_lead = lead;
    machine.octahedral = octahedral;
#endif
}

/* A pose about home, of the tip of the tool; a low one, where legs are nearly in the plane of the base, is nearly singular. */
static equipod_pose drawn(double shift, double degrees, int low)
{
    EmcPose world = {{0, 0, 0}, 0, 0, 0, 0, 0, 0};
    equipod_pose pose;
    world_of_pose(&equipod_home, &world);
    world.tran.z *= low ? 0.04 : 1;
    world.tran.x += shift * any(), world.tran.y += shift * any(), world.tran.z += shift * any();
    world.a += degrees * any(), world.b += degrees * any(), world.c += degrees * any();
    pose_of_world(&world, &pose);
    pose.position[0] -= machine.tool / EQUIPOD_UNIT_MILLIMETRES * pose.rotation[0][2];
    pose.position[1] -= machine.tool / EQUIPOD_UNIT_MILLIMETRES * pose.rotation[1][2];
    pose.position[2] -= machine.tool / EQUIPOD_UNIT_MILLIMETRES * (pose.rotation[2][2] - 1);
    return pose;
}

static double apart(const equipod_pose *a, const equipod_pose *b)
{
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        sum += (a->position[k] - b->position[k]) * (a->position[k] - b->position[k]);
    }
    return sqrt(sum);
}

static int has_values(const equipod_pose *pose, const double joints[LEGS])
{
    double own[LEGS], add[LEGS], off = 0;
    int i;
    if (!joints_at(&machine, pose, own, add)) {
        return 0;
    }
    for (i = 0; i < LEGS; i++) {
        off = fmax(off, fabs(own[i] - joints[i]));
    }
    return off <= 1e-11 * size;
}

/* Joint values are those of legs that show their lengths, with the offsets. */
static int shows_offsets(const equipod_pose *pose, const double joints[LEGS])
{
    machine_t plain = machine;
    double own[LEGS], add[LEGS], off = 0;
    int i;
    for (i = 0; i < LEGS; i++) {
        plain.leg_offset[i] = 0;
    }
    if (!joints_at(&plain, pose, own, add)) {
        return 0;
    }
    for (i = 0; i < LEGS; i++) {
        off = fmax(off, fabs(own[i] + machine.leg_offset[i] - joints[i]));
    }
    return off <= 1e-14 * size;
}

static void there_and_back(unsigned number)
{
    const double shift = 0.04 * size, degrees = 15;
    unsigned n;
    for (n = 0; n < CASES; n++) {
        double joints[LEGS], add[LEGS], condition;
        const equipod_pose pose = drawn(shift, degrees, n % 2);
        equipod_pose start = pose;
        equipod_result r;
        if (!joints_at(&machine, &pose, joints, add)) {
            continue;
        }
        check(shows_offsets(&pose, joints), "offsets of the legs", number);
        /* from the pose itself it comes back, whatever the joints and the tool are */
        (void)pose_from(&machine, joints, &start, &r);
        condition = r.frobenius_ratio;
        check(r.status == EQUIPOD_TRACKED || condition < LOST_BELOW, "a pose is tracked from itself", number);
        check(r.status != EQUIPOD_TRACKED || apart(&r.pose, &pose) <= 1e-11 * size / EQUIPOD_UNIT_MILLIMETRES / condition,
              "the pose tracked from itself", number);
#ifndef EQUIPOD_HAS_DRIVES
        check(r.status != EQUIPOD_TRACKED || r.position_error < 1e-6 * size / EQUIPOD_UNIT_MILLIMETRES / (condition * condition),
              "the bound of the error", number);
#endif
        /* a control loop begins a little aside; the start may be the place of the result */
        start.position[0] += 1e-3 * size / EQUIPOD_UNIT_MILLIMETRES;
        r.pose = start;
        if (condition > 1e-2) {
            (void)pose_from(&machine, joints, &r.pose, &r);
            /* a low pose may have another one with its joint values so near that the start lies between them */
            check(r.status == EQUIPOD_TRACKED || n % 2, "a pose is tracked from beside it", number);
            check(r.status != EQUIPOD_TRACKED || has_values(&r.pose, joints), "joint values of the pose from beside it", number);
            check(r.status != EQUIPOD_TRACKED || n % 2 || apart(&r.pose, &pose) <= 1e-8 * size / EQUIPOD_UNIT_MILLIMETRES,
                  "the pose from beside it", number);
        }
    }
}

/* What is not finite is refused, and never part of an answer. */
static void not_finite(void)
{
    const double bad[3] = {NAN, INFINITY, -INFINITY};
    EmcPose world = {{0, 0, 0}, 0, 0, 0, 0, 0, 0};
    double joints[LEGS], add[LEGS];
    equipod_pose pose;
    equipod_result r;
    unsigned n;
    for (n = 0; n < 3; n++) {
        int i, k;
        for (i = 0; i < LEGS; i++) {
            for (k = 0; k < 3; k++) {
                made(0, 0, 0, 1);
                machine.base[i][k] = bad[n];
                check(!ready(&machine), "a base joint that is not finite", n);
                made(0, 0, 0, 1);
                machine.platform[i][k] = bad[n];
                check(!ready(&machine), "a platform joint that is not finite", n);
            }
        }
        made(0, bad[n], 0, 1);
        check(!ready(&machine), "a tool that is not finite", n);
        made(0, 0, 0, 0);
        machine.screw_lead = bad[n];
        check(!ready(&machine) || !joints_at(&machine, &equipod_home, joints, add), "a lead that is not finite", n);
        made(0, 0, 0, 1);
        check(ready(&machine) && joints_at(&machine, &equipod_home, joints, add), "home", n);
        pose = equipod_home;
        pose.position[1] = bad[n];
        check(!joints_at(&machine, &pose, add, add), "a pose that is not finite", n);
        check(pose_from(&machine, joints, &pose, &r) == EQUIPOD_LOST, "a start that is not finite", n);
        check(pose_of_joints(&machine, joints, &pose, &pose, 0, &r) == EQUIPOD_TRACKED && apart(&r.pose, &equipod_home) < 1e-8 * size,
              "home where both starts lead to no pose", n);
        check(pose_of_joints(&machine, joints, &pose, 0, 0, &r) == EQUIPOD_TRACKED, "home without a last pose", n);
        world.b = bad[n];
        world_of_pose(&r.pose, &world);
        check(fabs(world.b) <= 180, "angles next to one that is not finite", n);
        joints[3] = bad[n];
        check(pose_of_joints(&machine, joints, &equipod_home, &equipod_home, 0, &r) != EQUIPOD_TRACKED && isinf(r.position_error),
              "a joint value that is not finite", n);
    }
}

int main(void)
{
    /* over the size: errors of measured joints, tools, leads */
    const double errors[4] = {0, 1e-4, 2e-3, 1e-2}, tools[3] = {0, 0.2, -1}, leads[2] = {0, 0.02};
    unsigned number = 0;
    int e, t, l, octahedral;
    size = equipod_nominal.unit * EQUIPOD_UNIT_MILLIMETRES;
    for (octahedral = 0; octahedral < 2; octahedral++) {
        for (e = 0; e < 4; e++) {
            for (t = 0; t < 3; t++) {
                for (l = 0; l < 2; l++) {
                    number += 1;
                    made(errors[e] * size, tools[t] * size, leads[l] * size, octahedral);
                    check(ready(&machine), "a machine", number);
                    there_and_back(number);
                }
            }
        }
    }
    not_finite();
    printf("%u machines, %u failed\n", number, failures);
    return failures != 0;
}

/* Instructions of the functions of equipod.c: SysTick ticks at 25 MHz and QEMU (-icount shift=0) takes a nanosecond for an instruction, so that a tick
 * is 40 instructions; each call is repeated. */
#include "equipod.h"
#include "equipod_design.h"

#include <stdint.h>
#include <stdio.h>

#define REPEATS 200u
#define PER_TICK 40u

static volatile uint32_t *const systick = (volatile uint32_t *)0xe000e010;

static uint32_t now(void)
{
    return 0xffffffu - systick[2];
}

static equipod_pose target_pose(real_t way)
{
    const real_t angles[3] = {(real_t)0.3 * way, (real_t)-0.2 * way, (real_t)0.25 * way};
    equipod_pose turn, pose = equipod_home;
    int i, j, k;
    equipod_pose_from_angles(equipod_home.position, angles, &turn);
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            pose.rotation[i][j] = 0;
            for (k = 0; k < 3; k++) {
                pose.rotation[i][j] += turn.rotation[i][k] * equipod_home.rotation[k][j];
            }
        }
        pose.position[i] += way * equipod_nominal.unit * (real_t)(i == 2 ? 0.3 : 0.2);
    }
    return pose;
}

#define MEASURE(name, call)                                                                             \
    do {                                                                                                \
        unsigned n;                                                                                     \
        const uint32_t began = now();                                                                   \
        uint32_t ticks;                                                                                 \
        for (n = 0; n < REPEATS; n++) {                                                                 \
            call;                                                                                       \
        }                                                                                               \
        ticks = (now() - began) & 0xffffffu;                                                            \
        printf("%s %lu\n", name, (unsigned long)((uint64_t)ticks * PER_TICK / REPEATS));                \
    } while (0)

int main(void)
{
    static real_t s[6], l[6], j[6][6];
    static equipod_result r;
    static equipod_margins margins;
    equipod_pose pose = target_pose((real_t)0.01);
    systick[1] = 0xffffffu;
    systick[2] = 0;
    systick[0] = 5; /* processor clock */
    MEASURE("lengths", equipod_lengths(&equipod_nominal, &pose, l));
    MEASURE("jacobian", equipod_jacobian(&equipod_nominal, &pose, j));
    MEASURE("margins", equipod_limit_margins(&equipod_design_limits, &equipod_nominal, &pose, &margins));
    equipod_squared_lengths(&equipod_nominal, &pose, s);
    MEASURE("correction", equipod_newton_steps(&equipod_nominal, s, &equipod_home, 1, &pose));
    MEASURE("track_near", equipod_track(&equipod_nominal, s, 0, &equipod_home, (real_t)EQUIPOD_SINGULAR, EQUIPOD_SEGMENTS, &r));
    printf("near_status %d\nnear_segments %u\nnear_steps %u\n", (int)r.status, r.segments, r.newton_steps);
    pose = target_pose((real_t)1);
    equipod_squared_lengths(&equipod_nominal, &pose, s);
    MEASURE("track_far", equipod_track(&equipod_nominal, s, 0, &equipod_home, (real_t)EQUIPOD_SINGULAR, 1000u, &r));
    printf("far_status %d\nfar_segments %u\nfar_steps %u\n", (int)r.status, r.segments, r.newton_steps);
    return 0;
}

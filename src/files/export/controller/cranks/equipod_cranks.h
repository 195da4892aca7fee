/* Rods of constant length on cranks: angles in place of lengths. C99, math.h only, no allocation, no recursion, no state.
 *
 * Crank i turns about the unit vector n_i through its centre c_i; at the angle q its tip is
 *     a_i(q) = c_i + r_i (e_i cos q + f_i sin q),    f_i = n_i x e_i,
 * and a rod of length l_i joins the tip to the platform joint b_i. Angles are radians, counted from 0 for the first leg. */
#ifndef EQUIPOD_CRANKS_H
#define EQUIPOD_CRANKS_H

#include "equipod.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Angles move by at most so much from one set of tips to the next while a pose is followed, radians. */
#define EQUIPOD_CRANK_STEP 0.05
/* Most such parts of a step where a caller states no other number: half a turn, and the bound on the work with EQUIPOD_SEGMENTS. */
#define EQUIPOD_CRANK_PARTS 64u

typedef struct {
    real_t centre[6][3];   /* c_i, base frame */
    real_t axis[6][3];     /* n_i */
    real_t zero[6][3];     /* e_i */
    real_t quarter[6][3];  /* f_i */
    real_t length[6];      /* r_i */
    real_t rod[6];         /* l_i */
    real_t platform[6][3]; /* b_i, platform frame */
    int plus[6];           /* 1: the crank stays on the side of the greater angle, 0: of the smaller one */
    int has_limits[6];
    real_t least[6], greatest[6];
} equipod_cranks;

/* Both angles of each crank that hold the pose: on the side it stays on, and on the other one (which may be null), within half a turn of the middle of
 * its limits, of 0 where it has none. 0, or the number from 1 of the first leg whose rod does not reach: the angles are then not to be used. */
int equipod_crank_angles(const equipod_cranks *cranks, const equipod_pose *pose, real_t kept[6], real_t other[6]);

/* What remains of the limits of each angle: negative beyond them, infinite where there are none. 1: all are met. */
int equipod_crank_margins(const equipod_cranks *cranks, const real_t angles[6], real_t margins[6]);

/* The tips of the cranks, base frame. */
void equipod_crank_tips(const equipod_cranks *cranks, const real_t angles[6], real_t tips[6][3]);

/* u_i . (n_i x t_i) for the unit vectors u_i along the rod and t_i along the crank, from -1 to 1: 0 where the crank is singular. */
void equipod_crank_transmissions(const equipod_cranks *cranks, const equipod_pose *pose, const real_t angles[6], real_t transmissions[6]);

/* Rows that take (dp/dt, omega), base frame, to the speeds of the cranks. 0 where a crank is singular or a rod has no length. */
int equipod_crank_jacobian(const equipod_cranks *cranks, const equipod_pose *pose, const real_t angles[6], real_t j[6][6]);

/* Continues the pose `start` (which may be `&result->pose`), which the cranks hold at the angles `from`, to the angles `to`: in at most `parts` equal parts of at most EQUIPOD_CRANK_STEP,
 * each followed by equipod_track on the new tips in at most `segments` segments. Angles further apart are EQUIPOD_LOST. The fraction counts from the
 * angles `from` on; segments and Newton steps are those of all parts, the Kantorovich number the greatest. */
equipod_status equipod_track_cranks(const equipod_cranks *cranks, const real_t from[6], const real_t to[6], const equipod_pose *start, real_t singular,
                                    unsigned parts, unsigned segments, equipod_result *result);

#ifdef __cplusplus
}
#endif

#endif

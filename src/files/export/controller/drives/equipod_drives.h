/* Drives that are not as long as the distances of their joints: universal joints whose axes do not meet, and screws that couple the turn of a leg
 * about itself to its length. A part of the library of equipod.h, which it needs.
 *
 * The first axis a of a joint goes through its centre; the second one is at the offset d from it towards the other end, along the unit vector w
 * across a. With the line s between the second axes and the angle psi about s from that at the base to that at the platform, from home:
 *
 *     drive = |s| - lead psi / (2 pi). */
#ifndef EQUIPOD_DRIVES_H
#define EQUIPOD_DRIVES_H

#include "equipod.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Steps of the fixed point of the directions to both second axes of a leg at most: a factor of a half needs 55. */
#define EQUIPOD_DIRECTION_STEPS 400
/* Steps of the fixed point of the corrections at most, and steps in which the change has to become smaller at least once. */
#define EQUIPOD_DRIVE_STEPS 200u
#define EQUIPOD_DRIVE_PATIENCE 8u

typedef struct {
    real_t axis[2][6][3]; /* first axes at the base, base frame, and at the platform, platform frame: unit vectors, zero for balls */
    real_t offset[2];     /* at the base, at the platform */
    real_t lead;          /* of a turn of one radian */
    real_t turned[6];     /* angles from second axis to second axis at home, radians */
    real_t size;          /* of the design, a length */
} equipod_drives;

/* The legs at a pose. */
typedef struct {
    real_t distance[6];   /* of the joints */
    real_t correction[6]; /* what the drive is longer */
    real_t of_offsets[6]; /* what of that is due to the offsets */
    real_t twist[6];      /* psi from home, -pi to pi; 0 without a lead */
    real_t line[6][3];    /* s, base frame */
    real_t rates[6][6];   /* rows: drive rate = row . (dp/dt, omega), both in the base frame */
} equipod_drive_state;

typedef enum {
    EQUIPOD_DRIVES_REACHED,        /* the corrections settled: the pose has the lengths asked for, within rounding */
    EQUIPOD_DRIVES_NOT_CONTRACTING,/* they did not settle: no pose */
    EQUIPOD_DRIVES_NOT_TRACKED,    /* the pose of the distances was not followed to its end, see near */
    EQUIPOD_DRIVES_NO_LENGTH       /* a drive has no length at a pose on the path */
} equipod_drive_status;

typedef struct {
    equipod_drive_status status;
    equipod_result near;   /* how the pose of the last distances was followed; its errors are about these distances */
    real_t distances[6];   /* distances of the joints that the last pose was followed to */
    unsigned steps;        /* of the fixed point */
    real_t factor;         /* greatest ratio of two changes of the corrections, one after the other; 0 where there were none */
} equipod_drive_result;

/* How far the pose with exactly these lengths of drives is from the one given, at most. */
typedef struct {
    real_t position;    /* of p */
    real_t angle;       /* of R, radians */
    real_t contraction; /* of the Newton map about the pose, below 1 */
} equipod_drive_bound;

/* The legs at a pose. 0, or the number from 1 of the first leg whose drive has no length: along a first axis, or with offsets too large for it. */
int equipod_drive_states(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, equipod_drive_state *state);

/* Inverse kinematics: the lengths to command. 0 or a leg as above. */
int equipod_drive_lengths(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, real_t lengths[6]);

/* Continues the pose `start` to other lengths of drives: distances are the lengths less the corrections at the last pose, each followed by equipod_track
 * in at most `segments` segments. At most EQUIPOD_DRIVE_STEPS times that; the fixed point contracts by a few hundredths a step in usual machines. */
equipod_drive_status equipod_track_drives(const equipod_drives *drives, const equipod_legs *legs, const real_t lengths[6], const equipod_pose *start,
                                          real_t singular, unsigned segments, equipod_drive_result *result);

/* Proves by an interval Newton test that exactly one pose near the one given has these lengths, and how near. 1: proved. It takes some hundred times
 * as long as a step of the fixed point. */
int equipod_bound_drives(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *home, const equipod_pose *pose,
                         const real_t lengths[6], equipod_drive_bound *bound);

#ifdef __cplusplus
}
#endif

#endif

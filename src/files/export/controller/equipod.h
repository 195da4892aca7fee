/* Kinematics of Gough-Stewart platforms for controllers: C99, math.h only, no allocation, no recursion, no state.
 *
 * Frames are right-handed. A pose (R, p) takes platform to base coordinates: x_base = R x_platform + p. Legs are counted from 0.
 * Lengths are in the unit of equipod_design.c, angles in radians unless a name says degrees.
 *
 * real_t is double, or float where EQUIPOD_FLOAT is defined for every file. */
#ifndef EQUIPOD_H
#define EQUIPOD_H

#ifdef EQUIPOD_FLOAT
typedef float real_t;
#else
typedef double real_t;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Most segments of a tracked pose where a caller states no other number: the bound on the iterations. */
#define EQUIPOD_SEGMENTS 8u
/* Newton corrections in a segment at most. */
#define EQUIPOD_CORRECTIONS 12u
/* Below this ratio 6 / (|J| |J^-1|) a pose counts as singular. */
#define EQUIPOD_SINGULAR 1e-6

typedef struct {
    real_t rotation[3][3]; /* R, row by row */
    real_t position[3];    /* p */
} equipod_pose;

/* The joints of six legs, made ready for the solver. equipod_prepare fills it from coordinates. */
typedef struct {
    real_t base[6][3];            /* a_i, base frame */
    real_t platform[6][3];        /* b_i, platform frame */
    real_t reduced_base[6][3];    /* (a_i - origin) / unit */
    real_t reduced_platform[6][3];/* (b_i - centre) / unit */
    real_t loose_base[6];         /* how far, at most, the joints are from these numbers, over unit */
    real_t loose_platform[6];
    real_t origin[3];             /* mean of the a_i */
    real_t centre[3];             /* mean of the b_i */
    real_t unit;                  /* twice the RMS distance of the b_i from their mean */
    real_t residual_scale;        /* unit^2 / size^2 */
} equipod_legs;

typedef enum {
    EQUIPOD_TRACKED,       /* the continuous continuation of the start, joined to it by regular poses */
    EQUIPOD_NEAR_SINGULAR, /* a singularity lies on the path or at its end */
    EQUIPOD_LOST           /* given up, see equipod_reason */
} equipod_status;

typedef enum {
    EQUIPOD_NO_REASON,
    EQUIPOD_START_IS_NO_POSE,   /* the matrix is not a rotation, or a number is not finite */
    EQUIPOD_SEGMENTS_EXHAUSTED, /* the lengths are too far from those of the start for the segments allowed */
    EQUIPOD_NO_CONVERGENCE      /* Newton's method did not end where it must; rounding is the only cause known */
} equipod_reason;

typedef struct {
    equipod_status status;
    equipod_reason reason;
    equipod_pose pose;       /* the pose asked for when tracked, else the last one before the end of the path */
    real_t fraction;         /* how far on the straight line of squared lengths, from 0 to 1 */
    unsigned segments;       /* segments of the path; of both paths where equipod_track_mapped follows two */
    unsigned newton_steps;   /* Newton steps in all */
    real_t kantorovich;      /* largest Kantorovich number of the segments, below 1 */
    real_t frobenius_ratio;  /* 6 / (|J| |J^-1|) at the pose: 1 at best, 0 at a singularity */
    real_t residual;         /* largest error of the leg equations at the pose over the squared size */
    real_t distance;         /* how far the mean of the platform joints moved */
    real_t position_error;   /* bound of the error of p at the pose; infinite where none is known */
    real_t angle_error;      /* bound of the error of R at the pose, radians */
} equipod_result;

/* An affine map of squared leg lengths: s_to = a s_from + c. */
typedef struct {
    real_t a[6][6];
    real_t c[6];
} equipod_map;

/* Limits of the legs; what is absent limits nothing. */
typedef struct {
    int has_length, has_base_cone_angle, has_platform_cone_angle;
    real_t least, greatest;           /* leg lengths */
    real_t base_cone_angle_degrees;        /* greatest angle between leg and axis at the base */
    real_t platform_cone_angle_degrees;    /* the same at the platform */
    real_t base_axis[6][3];           /* unit vectors, base frame */
    real_t platform_axis[6][3];       /* unit vectors, platform frame */
} equipod_limits;

typedef enum {
    EQUIPOD_TOO_SHORT,
    EQUIPOD_TOO_LONG,
    EQUIPOD_BASE_CONE_ANGLE,
    EQUIPOD_PLATFORM_CONE_ANGLE
} equipod_limit;

/* What remains of each limit, leg by leg: positive where it is met, infinite where nothing limits. */
typedef struct {
    real_t too_short[6], too_long[6];                   /* lengths */
    real_t base_cone_angle_degrees[6], platform_cone_angle_degrees[6];
    int met;                 /* 1: every limit is met */
    equipod_limit length_binds; /* which limit of the lengths is nearest, and of which leg */
    int length_leg;
    equipod_limit cone_angle_binds;  /* which cone angle is nearest to its limit, and of which leg */
    int cone_angle_leg;
} equipod_margins;

/* The free part of a path. */
typedef struct {
    real_t amount;       /* in the unit of the path: at its end every limit is met */
    equipod_pose pose;   /* the pose there */
    int binds;           /* 1: a limit is violated just beyond; 0: the path or the number of poses ended before */
    equipod_limit limit; /* which, and of which leg */
    int leg;
    unsigned poses;      /* poses examined */
} equipod_travel;

/* Makes six base and six platform joints ready: those measured on the machine, for instance. 0 where the joints have no size, or where a
 * coordinate is not finite: `legs` is then not to be used. */
int equipod_prepare(const real_t base[6][3], const real_t platform[6][3], equipod_legs *legs);

/* The pose at (x, y, z) turned by R = Rz(yaw) Ry(pitch) Rx(roll). */
void equipod_pose_from_angles(const real_t position[3], const real_t roll_pitch_yaw[3], equipod_pose *pose);

/* Roll, pitch and yaw of a pose: pitch from -pi/2 to pi/2, the others from -pi to pi. */
void equipod_angles(const equipod_pose *pose, real_t roll_pitch_yaw[3]);

/* Inverse kinematics: s_i = |R b_i + p - a_i|^2 and l_i = sqrt(s_i). */
void equipod_squared_lengths(const equipod_legs *legs, const equipod_pose *pose, real_t s[6]);
void equipod_lengths(const equipod_legs *legs, const equipod_pose *pose, real_t l[6]);

/* Rows [u_i, (R b_i) x u_i], u_i the unit vector along leg i: dl_i/dt = row . (dp/dt, omega), both in the base frame.
 * 0 where a leg has length zero. */
int equipod_jacobian(const equipod_legs *legs, const equipod_pose *pose, real_t j[6][6]);

/* How uncertain a pose is that is computed from shown lengths with joints and leg offsets that are uncertain themselves, to first order: the covariance of the shift of the
 * platform origin and of the rotation vector in radians, base frame. `joints` is the covariance by legs, of each a_i, b_i and the offset (7 numbers). The noise of the lengths is
 * not in it. 0 at a singular pose and where a leg has length zero. */
int equipod_pose_covariance(const equipod_legs *legs, const equipod_pose *pose, const real_t joints[42][42], real_t covariance[6][6]);

/* Continues the pose `start`, which may be `&result->pose`, to the squared lengths `s` in at most `segments` segments.
 * `radius` says how far the squares may be off, leg by leg; a null pointer says that they are exact. */
equipod_status equipod_track(const equipod_legs *legs, const real_t s[6], const real_t *radius, const equipod_pose *start,
                             real_t singular, unsigned segments, equipod_result *result);

/* `steps` plain Newton steps on the leg equations, without a test of where they lead: for a start so near to the pose that a step squares
 * its error, the correction by measured joints for instance. 0 where the start is no pose or singular. */
int equipod_newton_steps(const equipod_legs *legs, const real_t s[6], const equipod_pose *start, unsigned steps, equipod_pose *pose);

/* s_to and a bound of its rounding. 0, or the number from 1 of the first leg whose square is negative or not finite. */
int equipod_map_squares(const equipod_map *map, const real_t s[6], real_t to[6], real_t radius[6]);

/* The pose of a machine equivalent to an octahedral platform. The squares are mapped, the octahedral pose is tracked from `start`, and
 * `corrections` Newton steps, or some more, on the joints of the machine as measured correct it. Without corrections `measured` may be
 * null, and the result is that of the octahedral platform.
 * A corrected pose is EQUIPOD_TRACKED where the measured joints prove it: the test of equipod_track holds at the pose, and a ball of
 * regular poses about it holds `start`. Otherwise the pose is tracked from `start` on the measured joints, in at most `segments` segments
 * more, and that outcome counts. `position_error` of a tracked pose is finite. */
equipod_status equipod_track_mapped(const equipod_map *map, const equipod_legs *octahedral, const equipod_legs *measured, const real_t s[6],
                                    const equipod_pose *start, real_t singular, unsigned segments, unsigned corrections,
                                    equipod_result *result);

/* What remains of each limit at a pose. */
void equipod_limit_margins(const equipod_limits *limits, const equipod_legs *legs, const equipod_pose *pose, equipod_margins *margins);

/* The free part of the path p(t) = p + t velocity, R(t) = exp(t [turn]) R, t from 0 to `most`: unit vectors as velocity or turn move one
 * axis. Steps are such that neither lengths nor cone angles can be violated between two poses, but for steps of a hundred-thousandth (float: a
 * thousandth) of the unit where one of them is nearly zero. `poses` bounds the poses examined: what is free of the path up to there is the
 * answer then. 0 where a limit is violated at the start. */
int equipod_free_path(const equipod_limits *limits, const equipod_legs *legs, const equipod_pose *start, const real_t velocity[3], const real_t turn[3],
                     real_t most, unsigned poses, equipod_travel *travel);

#ifdef __cplusplus
}
#endif

#endif

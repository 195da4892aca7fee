/* Kinematics of rods on cranks for controllers, see equipod_cranks.h. The operations are those of the library in the same order; its sines and arcs are those of
 * its own mathematical functions, so that numbers agree to some roundings and not bit for bit. */
#include "equipod_cranks.h"

#include <float.h>
#include <math.h>
#include <string.h>

#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

#define R(x) ((real_t)(x))

#ifdef EQUIPOD_FLOAT
#define SQRT sqrtf
#define FABS fabsf
#define SIN sinf
#define COS cosf
#define ACOS acosf
#define ATAN2 atan2f
#define HYPOT hypotf
#define FLOOR floorf
#define CEIL ceilf
/* A cosine that is greater than 1 by so little is 1 rounded. */
#define ROUNDING 5e-6
#else
#define SQRT sqrt
#define FABS fabs
#define SIN sin
#define COS cos
#define ACOS acos
#define ATAN2 atan2
#define HYPOT hypot
#define FLOOR floor
#define CEIL ceil
#define ROUNDING 1e-14
#endif

#define TURN R(6.283185307179586)

static real_t dot(const real_t a[3], const real_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const real_t a[3], const real_t b[3], real_t out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* R b, and R b + p. */
static void placed(const equipod_pose *pose, const real_t b[3], real_t turned[3], real_t at[3])
{
    int k;
    for (k = 0; k < 3; k += 1) {
        turned[k] = dot(pose->rotation[k], b);
        at[k] = turned[k] + pose->position[k];
    }
}

/* The same angle within half a turn of the middle of the limits. */
static real_t counted(const equipod_cranks *cranks, int leg, real_t angle)
{
    const real_t middle = cranks->has_limits[leg] ? R(0.5) * (cranks->least[leg] + cranks->greatest[leg]) : R(0);
    const real_t away = angle - middle;
    return middle + (away - TURN * FLOOR(away / TURN + R(0.5)));
}

int equipod_crank_angles(const equipod_cranks *cranks, const equipod_pose *pose, real_t kept[6], real_t other[6])
{
    int i, k;
    for (i = 0; i < 6; i += 1) {
        const real_t r = cranks->length[i], l = cranks->rod[i];
        real_t turned[3], d[3], x, y, cosine, half, first;
        placed(pose, cranks->platform[i], turned, d);
        for (k = 0; k < 3; k += 1) {
            d[k] -= cranks->centre[i][k];
        }
        x = dot(d, cranks->zero[i]);
        y = dot(d, cranks->quarter[i]);
        cosine = (dot(d, d) + r * r - l * l) / (R(2) * r) / HYPOT(x, y);
        if (!(FABS(cosine) <= R(1) + R(ROUNDING))) {
            return i + 1;
        }
        cosine = cosine > R(1) ? R(1) : cosine < R(-1) ? R(-1) : cosine;
        half = ACOS(cosine);
        first = ATAN2(y, x);
        kept[i] = counted(cranks, i, cranks->plus[i] ? first + half : first - half);
        if (other) {
            other[i] = counted(cranks, i, cranks->plus[i] ? first - half : first + half);
        }
    }
    return 0;
}

int equipod_crank_margins(const equipod_cranks *cranks, const real_t angles[6], real_t margins[6])
{
    int i, met = 1;
    for (i = 0; i < 6; i += 1) {
        const real_t low = angles[i] - cranks->least[i], high = cranks->greatest[i] - angles[i];
        margins[i] = R(HUGE_VAL);
        if (cranks->has_limits[i]) {
            margins[i] = low < high ? low : high;
            met = met && margins[i] >= R(0);
        }
    }
    return met;
}

void equipod_crank_tips(const equipod_cranks *cranks, const real_t angles[6], real_t tips[6][3])
{
    int i, k;
    for (i = 0; i < 6; i += 1) {
        const real_t c = COS(angles[i]), s = SIN(angles[i]);
        for (k = 0; k < 3; k += 1) {
            tips[i][k] = cranks->centre[i][k] + (cranks->zero[i][k] * c + cranks->quarter[i][k] * s) * cranks->length[i];
        }
    }
}

/* The unit vector along each rod, R b of its platform joint, and the transmission of its crank. 0 for a rod without a length. */
static int rods(const equipod_cranks *cranks, const equipod_pose *pose, const real_t angles[6], real_t along[6][3], real_t turned[6][3],
                real_t transmissions[6])
{
    real_t tips[6][3];
    int i, k, sound = 1;
    equipod_crank_tips(cranks, angles, tips);
    for (i = 0; i < 6; i += 1) {
        real_t end[3], arm[3], across[3], far;
        placed(pose, cranks->platform[i], turned[i], end);
        for (k = 0; k < 3; k += 1) {
            along[i][k] = end[k] - tips[i][k];
            arm[k] = (tips[i][k] - cranks->centre[i][k]) / cranks->length[i];
        }
        far = SQRT(dot(along[i], along[i]));
        sound = sound && far > R(0);
        for (k = 0; k < 3; k += 1) {
            along[i][k] = far > R(0) ? along[i][k] / far : R(0);
        }
        cross(cranks->axis[i], arm, across);
        transmissions[i] = dot(along[i], across);
    }
    return sound;
}

void equipod_crank_transmissions(const equipod_cranks *cranks, const equipod_pose *pose, const real_t angles[6], real_t transmissions[6])
{
    real_t along[6][3], turned[6][3];
    (void)rods(cranks, pose, angles, along, turned, transmissions);
}

int equipod_crank_jacobian(const equipod_cranks *cranks, const equipod_pose *pose, const real_t angles[6], real_t j[6][6])
{
    real_t along[6][3], turned[6][3], transmissions[6];
    int i, k, sound = rods(cranks, pose, angles, along, turned, transmissions);
    for (i = 0; i < 6; i += 1) {
        const real_t by = cranks->length[i] * transmissions[i];
        real_t moment[3];
        if (!(FABS(by) > R(0))) {
            return 0;
        }
        cross(turned[i], along[i], moment);
        for (k = 0; k < 3; k += 1) {
            j[i][k] = along[i][k] / by;
            j[i][k + 3] = moment[k] / by;
        }
    }
    return sound;
}

equipod_status equipod_track_cranks(const equipod_cranks *cranks, const real_t from[6], const real_t to[6], const equipod_pose *start, real_t singular,
                                    unsigned parts, unsigned segments, equipod_result *result)
{
    const equipod_pose began = *start; /* `start` may be the pose of the result */
    real_t largest = R(0), squares[6], steps;
    equipod_result part;
    unsigned k;
    int i;
    memset(result, 0, sizeof *result);
    result->pose = began;
    result->position_error = R(INFINITY);
    result->angle_error = R(INFINITY);
    for (i = 0; i < 6; i += 1) {
        const real_t far = FABS(to[i] - from[i]);
        largest = far > largest ? far : largest;
        squares[i] = cranks->rod[i] * cranks->rod[i];
    }
    steps = CEIL(largest / R(EQUIPOD_CRANK_STEP));
    steps = steps < R(1) ? R(1) : steps;
    if (!(steps <= (real_t)parts)) {
        result->status = EQUIPOD_LOST;
        result->reason = EQUIPOD_SEGMENTS_EXHAUSTED;
        return result->status;
    }
    for (k = 1; (real_t)k <= steps; k += 1) {
        real_t angles[6], tips[6][3];
        equipod_legs legs;
        for (i = 0; i < 6; i += 1) {
            angles[i] = from[i] + (to[i] - from[i]) * ((real_t)k / steps);
        }
        equipod_crank_tips(cranks, angles, tips);
        /* angles that are no numbers end here */
        if (!equipod_prepare((const real_t(*)[3])tips, cranks->platform, &legs)) {
            result->status = EQUIPOD_LOST;
            result->reason = EQUIPOD_NO_CONVERGENCE;
            return result->status;
        }
        (void)equipod_track(&legs, squares, 0, &result->pose, singular, segments, &part);
        part.segments += result->segments;
        part.newton_steps += result->newton_steps;
        part.kantorovich = part.kantorovich > result->kantorovich ? part.kantorovich : result->kantorovich;
        part.distance += result->distance;
        part.fraction = ((real_t)(k - 1u) + (part.status == EQUIPOD_TRACKED ? R(1) : part.fraction)) / steps;
        *result = part;
        if (part.status != EQUIPOD_TRACKED) {
            return part.status;
        }
    }
    return result->status;
}

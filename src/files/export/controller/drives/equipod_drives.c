/* Drives that are not as long as the distances of their joints, see equipod_drives.h.
 *
 * In double every number of the states and of the tracked poses is that of the library, bit for bit, where the arc tangent of the mathematical library
 * is the same; bounds of errors use another approximate inverse and agree to their first digits. Intervals are results rounded outwards by nextafter. */
#include "equipod_drives.h"

#include <float.h>
#include <math.h>

#ifdef __FAST_MATH__
#error "equipod_drives.c: the bounds are proofs only where operations keep their order; compile without -ffast-math"
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

#define R(x) ((real_t)(x))

#ifdef EQUIPOD_FLOAT
#define SQRT sqrtf
#define FABS fabsf
#define ACOS acosf
#define ATAN2 atan2f
#define ROUND roundf
#define NEXT nextafterf
#define EPSILON FLT_EPSILON
#define LEAST FLT_MIN
/* What rounding leaves of corrections that settled, over the size. */
#define SETTLED 5e-5
#define SLACK 5e-7
#define PI_BELOW 3.1415925
#else
#define SQRT sqrt
#define FABS fabs
#define ACOS acos
#define ATAN2 atan2
#define ROUND round
#define NEXT nextafter
#define EPSILON DBL_EPSILON
#define LEAST DBL_MIN
#define SETTLED 1e-13
#define SLACK 1e-15
#define PI_BELOW 3.141592653589793
#endif

#define TURN 6.283185307179586
/* Rounds of shrinking the enclosures of the directions of a leg. */
#define ROUNDS 12
/* Sizes of the neighbourhood tried, each this much wider than the last. */
#define WIDER 30
#define TRIES 3
/* Terms of the series of the cosine. */
#define TERMS 30

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

static int is_finite(real_t x)
{
    return x - x == R(0);
}

/* A leg at a pose, base frame. */
typedef struct {
    real_t line[3], arm[3], axes[2][3];
} placed_leg;

static int needs(const equipod_drives *drives, int end)
{
    return drives->offset[end] != R(0) || drives->lead != R(0);
}

static void place_leg(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, int i, placed_leg *out)
{
    int k;
    for (k = 0; k < 3; k++) {
        out->arm[k] = dot(pose->rotation[k], legs->platform[i]);
        out->line[k] = out->arm[k] + pose->position[k] - legs->base[i][k];
        out->axes[0][k] = drives->axis[0][i][k];
        out->axes[1][k] = dot(pose->rotation[k], drives->axis[1][i]);
    }
}

/* v over its length; 0 where it has none. */
static int unit(const real_t v[3], real_t out[3])
{
    const real_t length = SQRT(dot(v, v));
    int k;
    for (k = 0; k < 3; k++) {
        out[k] = v[k] / length;
    }
    return length > R(0);
}

/* The direction of the part across the first axis at an end, when the other end is where `other` says. */
static int direction(const equipod_drives *drives, const placed_leg *leg, int end, const real_t other[3], real_t out[3])
{
    real_t v[3], aside[3], part[3];
    int k;
    for (k = 0; k < 3; k++) {
        v[k] = leg->line[k] - other[k] * drives->offset[1 - end];
    }
    cross(v, leg->axes[end], aside);
    cross(leg->axes[end], aside, part);
    return unit(part, out);
}

/* The directions to both second axes. 0 where they are not determined. */
static int directions(const equipod_drives *drives, const placed_leg *leg, real_t ends[2][3])
{
    const real_t product = drives->offset[0] * drives->offset[1];
    real_t reach[2];
    int end, k, step;
    reach[0] = R(HUGE_VAL);
    reach[1] = R(HUGE_VAL);
    for (end = 0; end < 2; end++) {
        real_t aside[3], r;
        for (k = 0; k < 3; k++) {
            ends[end][k] = R(0);
        }
        if (!needs(drives, end)) {
            continue;
        }
        cross(leg->axes[end], leg->line, aside);
        r = SQRT(dot(aside, aside)) - drives->offset[1 - end];
        if (!(r > R(0))) {
            return 0;
        }
        reach[end] = r;
    }
    if (product > R(0) && !(product < reach[0] * reach[1])) {
        return 0;
    }
    for (step = 0; step < EQUIPOD_DIRECTION_STEPS; step++) {
        real_t before[2][3], moved = R(0);
        for (end = 0; end < 2; end++) {
            for (k = 0; k < 3; k++) {
                before[end][k] = ends[end][k];
            }
        }
        for (end = 0; end < 2; end++) {
            if (needs(drives, end) && !direction(drives, leg, end, ends[1 - end], ends[end])) {
                return 0;
            }
        }
        for (end = 0; end < 2; end++) {
            for (k = 0; k < 3; k++) {
                const real_t change = FABS(ends[end][k] - before[end][k]);
                moved = change > moved ? change : moved;
            }
        }
        /* without two offsets the second step changes nothing */
        if (step > 0 && (product == R(0) || moved <= R(4) * R(EPSILON))) {
            return 1;
        }
    }
    return 0;
}

/* From the second axis at the base to that at the platform. */
static void between(const equipod_drives *drives, const placed_leg *leg, real_t ends[2][3], real_t s[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        s[k] = leg->line[k] - ends[0][k] * drives->offset[0] - ends[1][k] * drives->offset[1];
    }
}

/* Sine and cosine of the angle about the leg between the second axes. */
static int twist_of(const placed_leg *leg, real_t ends[2][3], const real_t s[3], real_t *sine, real_t *cosine)
{
    real_t u[3], e[2][3], across[3];
    if (!unit(s, u)) {
        return 0;
    }
    cross(leg->axes[0], ends[0], e[0]);
    cross(leg->axes[1], ends[1], e[1]);
    cross(e[0], e[1], across);
    *sine = dot(u, across);
    *cosine = dot(e[0], e[1]);
    return 1;
}

static void row_of(const real_t force[3], const real_t moment[3], real_t row[6])
{
    int k;
    for (k = 0; k < 3; k++) {
        row[k] = force[k];
        row[k + 3] = moment[k];
    }
}

/* Rates of |s| and of the twist: docs/theory/joints.md. */
static int rates_of(const equipod_drives *drives, const placed_leg *leg, real_t ends[2][3], const real_t s[3], real_t length[6], real_t twist[6])
{
    real_t u[3], m[3], moment[3], e[2][3], first[6], second[6], far[3];
    real_t own, other, mixed, determinant, ua, ub;
    int k;
    if (!unit(s, u)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        m[k] = leg->arm[k] - ends[1][k] * drives->offset[1];
    }
    cross(m, u, moment);
    row_of(u, moment, length);
    for (k = 0; k < 6; k++) {
        twist[k] = R(0);
    }
    if (drives->lead == R(0)) {
        return 1;
    }
    cross(leg->axes[0], ends[0], e[0]);
    cross(leg->axes[1], ends[1], e[1]);
    own = dot(s, ends[0]) + drives->offset[0];
    other = dot(s, ends[1]) + drives->offset[1];
    mixed = dot(e[0], e[1]);
    determinant = own * other - drives->offset[0] * drives->offset[1] * mixed * mixed;
    cross(m, e[0], moment);
    row_of(e[0], moment, first);
    for (k = 0; k < 3; k++) {
        far[k] = m[k] - s[k];
    }
    cross(far, e[1], moment);
    row_of(e[1], moment, second);
    ua = dot(u, leg->axes[0]);
    ub = dot(u, leg->axes[1]);
    if (determinant == R(0)) {
        return 0;
    }
    for (k = 0; k < 6; k++) {
        const real_t q = (first[k] * other - second[k] * drives->offset[1] * mixed) / determinant;
        const real_t q2 = (second[k] * own - first[k] * drives->offset[0] * mixed) / determinant;
        const real_t direct = k < 3 ? R(0) : u[k - 3];
        twist[k] = direct + ub * q2 - ua * q;
    }
    return 1;
}

static int state_of(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, int i, equipod_drive_state *out)
{
    placed_leg leg;
    real_t ends[2][3], moved[3], length[6], turn[6];
    real_t *s = out->line[i];
    int k;
    place_leg(drives, legs, pose, i, &leg);
    if (!directions(drives, &leg, ends)) {
        return 0;
    }
    between(drives, &leg, ends, s);
    for (k = 0; k < 3; k++) {
        moved[k] = leg.line[k] - s[k];
    }
    out->distance[i] = SQRT(dot(leg.line, leg.line));
    /* |s| - |d|, without the loss of a difference */
    out->of_offsets[i] = (dot(moved, moved) - R(2) * dot(leg.line, moved)) / (SQRT(dot(s, s)) + out->distance[i]);
    out->twist[i] = R(0);
    if (drives->lead != R(0)) {
        real_t sine, cosine, turned;
        if (!twist_of(&leg, ends, s, &sine, &cosine)) {
            return 0;
        }
        turned = ATAN2(sine, cosine) - drives->turned[i];
        out->twist[i] = turned - R(TURN) * ROUND(turned / R(TURN));
    }
    if (!rates_of(drives, &leg, ends, s, length, turn)) {
        return 0;
    }
    out->correction[i] = out->of_offsets[i] - drives->lead * out->twist[i];
    for (k = 0; k < 6; k++) {
        out->rates[i][k] = length[k] - drives->lead * turn[k];
        if (!is_finite(out->rates[i][k])) {
            return 0;
        }
    }
    return is_finite(out->correction[i]);
}

int equipod_drive_states(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, equipod_drive_state *state)
{
    int i;
    for (i = 0; i < 6; i++) {
        if (!state_of(drives, legs, pose, i, state)) {
            return i + 1;
        }
    }
    return 0;
}

int equipod_drive_lengths(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, real_t lengths[6])
{
    equipod_drive_state state;
    const int missing = equipod_drive_states(drives, legs, pose, &state);
    int i;
    for (i = 0; i < 6 && !missing; i++) {
        lengths[i] = state.distance[i] + state.correction[i];
    }
    return missing;
}

equipod_drive_status equipod_track_drives(const equipod_drives *drives, const equipod_legs *legs, const real_t lengths[6], const equipod_pose *start,
                                          real_t singular, unsigned segments, equipod_drive_result *result)
{
    equipod_pose from = *start;
    equipod_drive_state state;
    real_t last = R(HUGE_VAL), least = R(HUGE_VAL);
    unsigned since = 0;
    int i;
    result->status = EQUIPOD_DRIVES_NOT_CONTRACTING;
    result->steps = 0;
    result->factor = R(0);
    result->near.status = EQUIPOD_LOST;
    result->near.reason = EQUIPOD_NO_CONVERGENCE;
    result->near.pose = *start;
    for (i = 0; i < 6; i++) {
        result->distances[i] = lengths[i];
    }
    if (equipod_drive_states(drives, legs, &from, &state)) {
        return result->status = EQUIPOD_DRIVES_NO_LENGTH;
    }
    while (result->steps < EQUIPOD_DRIVE_STEPS) {
        real_t s[6], before[6], change = R(0);
        int settled;
        for (i = 0; i < 6; i++) {
            before[i] = state.correction[i];
            result->distances[i] = lengths[i] - before[i];
            if (!(result->distances[i] >= R(0)) || !is_finite(result->distances[i])) {
                return result->status = EQUIPOD_DRIVES_NOT_TRACKED;
            }
            s[i] = result->distances[i] * result->distances[i];
        }
        equipod_track(legs, s, 0, &from, singular, segments, &result->near);
        result->steps += 1;
        if (result->near.status != EQUIPOD_TRACKED) {
            return result->status = EQUIPOD_DRIVES_NOT_TRACKED;
        }
        from = result->near.pose;
        if (equipod_drive_states(drives, legs, &from, &state)) {
            return result->status = EQUIPOD_DRIVES_NO_LENGTH;
        }
        for (i = 0; i < 6; i++) {
            const real_t own = FABS(state.correction[i] - before[i]);
            change = own > change ? own : change;
        }
        /* what rounding leaves of a change */
        settled = change <= R(16) * R(EPSILON) * drives->size;
        if (!settled) {
            if (is_finite(last) && result->steps > 2) {
                result->factor = change / last > result->factor ? change / last : result->factor;
            }
            since = change < R(0.9) * least ? 0 : since + 1;
            last = change;
            least = change < least ? change : least;
            if (since < EQUIPOD_DRIVE_PATIENCE) {
                continue;
            }
        }
        /* rounding of the pose may keep corrections from settling to the last bit; those that grew away from a pose did not settle */
        if (settled || last <= R(SETTLED) * drives->size) {
            result->status = EQUIPOD_DRIVES_REACHED;
        }
        return result->status;
    }
    return result->status;
}

/* Intervals. A bound that is not known is infinite. */
typedef struct {
    real_t lo, hi;
} interval;

static real_t down(real_t x)
{
    return NEXT(x, R(-HUGE_VAL));
}

static real_t up(real_t x)
{
    return NEXT(x, R(HUGE_VAL));
}

static interval span(real_t lo, real_t hi)
{
    interval out;
    out.lo = lo;
    out.hi = hi;
    return out;
}

static interval point(real_t x)
{
    return is_finite(x) ? span(x, x) : span(R(-HUGE_VAL), R(HUGE_VAL));
}

static interval about_zero(real_t radius)
{
    return radius >= R(0) && is_finite(radius) ? span(-radius, radius) : span(R(-HUGE_VAL), R(HUGE_VAL));
}

static int is_zero(interval a)
{
    return a.lo == R(0) && a.hi == R(0);
}

static real_t magnitude(interval a)
{
    return FABS(a.lo) > FABS(a.hi) ? FABS(a.lo) : FABS(a.hi);
}

static interval add(interval a, interval b)
{
    return is_zero(a) ? b : is_zero(b) ? a : span(down(a.lo + b.lo), up(a.hi + b.hi));
}

static interval minus(interval a)
{
    return span(-a.hi, -a.lo);
}

static interval subtract(interval a, interval b)
{
    return add(a, minus(b));
}

static interval multiply(interval a, interval b)
{
    const real_t ends[4][2] = {{a.lo, b.lo}, {a.lo, b.hi}, {a.hi, b.lo}, {a.hi, b.hi}};
    interval out = span(R(HUGE_VAL), R(-HUGE_VAL));
    int k;
    for (k = 0; k < 4; k++) {
        /* zero times infinity is zero because the infinite end is not attained */
        const int none = ends[k][0] == R(0) || ends[k][1] == R(0);
        const real_t product = none ? R(0) : ends[k][0] * ends[k][1];
        const real_t low = none ? R(0) : down(product), high = none ? R(0) : up(product);
        out.lo = low < out.lo ? low : out.lo;
        out.hi = high > out.hi ? high : out.hi;
    }
    return out;
}

static interval square(interval a)
{
    interval out = multiply(a, a);
    if (a.lo <= R(0) && a.hi >= R(0)) {
        out.lo = R(0);
    }
    out.lo = out.lo < R(0) ? R(0) : out.lo;
    return out;
}

static int root(interval a, interval *out)
{
    if (!(a.hi >= R(0))) {
        return 0;
    }
    out->lo = a.lo > R(0) ? down(SQRT(a.lo)) : R(0);
    out->hi = a.hi > R(0) ? up(SQRT(a.hi)) : R(0);
    return 1;
}

static int divide(interval a, interval b, interval *out)
{
    real_t ends[4];
    int k;
    if (!(b.lo > R(0) || b.hi < R(0)) || !is_finite(b.lo) || !is_finite(b.hi)) {
        return 0;
    }
    ends[0] = a.lo / b.lo;
    ends[1] = a.lo / b.hi;
    ends[2] = a.hi / b.lo;
    ends[3] = a.hi / b.hi;
    *out = span(ends[0], ends[0]);
    for (k = 1; k < 4; k++) {
        out->lo = ends[k] < out->lo ? ends[k] : out->lo;
        out->hi = ends[k] > out->hi ? ends[k] : out->hi;
    }
    *out = span(down(out->lo), up(out->hi));
    return 1;
}

static interval meet(interval a, interval b)
{
    interval out = span(a.lo > b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi);
    return out.lo <= out.hi ? out : a;
}

static interval idot(interval a[3], interval b[3])
{
    return add(add(multiply(a[0], b[0]), multiply(a[1], b[1])), multiply(a[2], b[2]));
}

static void icross(interval a[3], interval b[3], interval out[3])
{
    out[0] = subtract(multiply(a[1], b[2]), multiply(a[2], b[1]));
    out[1] = subtract(multiply(a[2], b[0]), multiply(a[0], b[2]));
    out[2] = subtract(multiply(a[0], b[1]), multiply(a[1], b[0]));
}

static int iunit(interval v[3], interval out[3])
{
    interval length;
    return root(add(add(square(v[0]), square(v[1])), square(v[2])), &length) && divide(v[0], length, &out[0]) && divide(v[1], length, &out[1]) &&
           divide(v[2], length, &out[2]);
}

/* The poses about one: translations and turns within `reach`, each coordinate in its unit. */
typedef struct {
    interval rotation[3][3], position[3];
    real_t tilt; /* bounds the entries of J - I, J the left Jacobian of the turn */
} neighbourhood;

/* The rotation of the quaternion of a matrix, which is one exactly whatever its norm. */
static void exact_rotation(const equipod_pose *pose, interval out[3][3])
{
    const real_t(*m)[3] = pose->rotation;
    const real_t trace = m[0][0] + m[1][1] + m[2][2];
    real_t q[4], d;
    interval v[3], w, factor, sum, skew[3][3];
    int i, j;
    if (trace > R(0)) {
        d = SQRT(trace + R(1)) * R(2);
        q[0] = R(0.25) * d;
        q[1] = (m[2][1] - m[1][2]) / d;
        q[2] = (m[0][2] - m[2][0]) / d;
        q[3] = (m[1][0] - m[0][1]) / d;
    } else if (m[0][0] > m[1][1] && m[0][0] > m[2][2]) {
        d = SQRT(R(1) + m[0][0] - m[1][1] - m[2][2]) * R(2);
        q[0] = (m[2][1] - m[1][2]) / d;
        q[1] = R(0.25) * d;
        q[2] = (m[0][1] + m[1][0]) / d;
        q[3] = (m[0][2] + m[2][0]) / d;
    } else if (m[1][1] > m[2][2]) {
        d = SQRT(R(1) + m[1][1] - m[0][0] - m[2][2]) * R(2);
        q[0] = (m[0][2] - m[2][0]) / d;
        q[1] = (m[0][1] + m[1][0]) / d;
        q[2] = R(0.25) * d;
        q[3] = (m[1][2] + m[2][1]) / d;
    } else {
        d = SQRT(R(1) + m[2][2] - m[0][0] - m[1][1]) * R(2);
        q[0] = (m[1][0] - m[0][1]) / d;
        q[1] = (m[0][2] + m[2][0]) / d;
        q[2] = (m[1][2] + m[2][1]) / d;
        q[3] = R(0.25) * d;
    }
    w = point(q[0]);
    sum = square(w);
    for (i = 0; i < 3; i++) {
        v[i] = point(q[i + 1]);
        sum = add(sum, square(v[i]));
        skew[i][i] = point(R(0));
    }
    skew[0][1] = minus(v[2]);
    skew[0][2] = v[1];
    skew[1][0] = v[2];
    skew[1][2] = minus(v[0]);
    skew[2][0] = minus(v[1]);
    skew[2][1] = v[0];
    if (!divide(point(R(2)), sum, &factor)) {
        factor = point(R(HUGE_VAL));
    }
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            const interval second = i == j ? minus(add(square(v[(i + 1) % 3]), square(v[(i + 2) % 3]))) : multiply(v[i], v[j]);
            out[i][j] = multiply(factor, add(multiply(w, skew[i][j]), second));
            if (i == j) {
                out[i][j] = add(point(R(1)), out[i][j]);
            }
        }
    }
}

static void neighbourhood_of(const equipod_pose *pose, real_t reach, real_t unit_of_length, neighbourhood *out)
{
    /* |w| is at most sqrt 3 times a coordinate, and exp [w]x differs from I by no more */
    const real_t turn = up(R(1.7321) * reach);
    const interval wide = about_zero(turn), shift = multiply(point(reach), point(unit_of_length));
    interval exact[3][3];
    int i, j, k;
    exact_rotation(pose, exact);
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            out->rotation[i][j] = exact[i][j];
            for (k = 0; k < 3 && turn > R(0); k++) {
                out->rotation[i][j] = add(out->rotation[i][j], multiply(wide, exact[k][j]));
            }
        }
        out->position[i] = add(point(pose->position[i]), about_zero(shift.hi));
    }
    out->tilt = up(turn * up(R(0.5) + turn));
}

/* A leg over a neighbourhood. */
typedef struct {
    interval line[3], arm[3], axes[2][3], ends[2][3], offset[2], s[3];
} enclosed_leg;

static int idirection(const enclosed_leg *leg, int end, interval out[3])
{
    interval v[3], axis[3], aside[3], part[3];
    int k;
    for (k = 0; k < 3; k++) {
        v[k] = subtract(leg->line[k], multiply(leg->ends[1 - end][k], leg->offset[1 - end]));
        axis[k] = leg->axes[end][k];
    }
    icross(v, axis, aside);
    icross(axis, aside, part);
    return iunit(part, out);
}

static int enclose(const equipod_drives *drives, const equipod_legs *legs, neighbourhood *at, int i, enclosed_leg *out)
{
    interval b[3], axis[3];
    int k, end, round;
    for (k = 0; k < 3; k++) {
        b[k] = point(legs->platform[i][k]);
        axis[k] = point(drives->axis[1][i][k]);
        out->axes[0][k] = point(drives->axis[0][i][k]);
    }
    if ((needs(drives, 0) && !iunit(out->axes[0], out->axes[0])) || (needs(drives, 1) && !iunit(axis, axis))) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        out->arm[k] = idot(at->rotation[k], b);
        out->line[k] = subtract(add(out->arm[k], at->position[k]), point(legs->base[i][k]));
        out->axes[1][k] = idot(at->rotation[k], axis);
        for (end = 0; end < 2; end++) {
            out->offset[end] = point(drives->offset[end]);
            out->ends[end][k] = needs(drives, end) ? about_zero(R(1)) : point(R(0));
        }
    }
    for (round = 0; round < ROUNDS; round++) {
        for (end = 0; end < 2; end++) {
            interval next[3];
            /* the first rounds may say nothing where the offsets are large */
            if (needs(drives, end) && idirection(out, end, next)) {
                for (k = 0; k < 3; k++) {
                    out->ends[end][k] = meet(next[k], out->ends[end][k]);
                }
            }
        }
    }
    for (k = 0; k < 3; k++) {
        out->s[k] = subtract(subtract(out->line[k], multiply(out->ends[0][k], out->offset[0])), multiply(out->ends[1][k], out->offset[1]));
    }
    return 1;
}

static int itwist(enclosed_leg *leg, interval *sine, interval *cosine)
{
    interval u[3], e[2][3], across[3];
    if (!iunit(leg->s, u)) {
        return 0;
    }
    icross(leg->axes[0], leg->ends[0], e[0]);
    icross(leg->axes[1], leg->ends[1], e[1]);
    icross(e[0], e[1], across);
    *sine = idot(u, across);
    *cosine = idot(e[0], e[1]);
    return 1;
}

/* The cosine of an angle from 0 to pi, by its series. */
static interval cosine_of(real_t angle)
{
    const interval s = square(point(angle));
    interval term = point(R(1)), sum = point(R(0));
    int i;
    for (i = 0; i < TERMS; i++) {
        interval next;
        sum = add(sum, term);
        if (!divide(minus(multiply(term, s)), point((real_t)((2 * i + 1) * (2 * i + 2))), &next)) {
            return about_zero(R(HUGE_VAL));
        }
        term = next;
    }
    return add(sum, about_zero(magnitude(term)));
}

static interval arc_cosine(interval cosine)
{
    interval out = span(R(0), up(R(PI_BELOW)));
    real_t slack = R(SLACK), guess;
    int k, done;
    guess = ACOS(cosine.hi > R(1) ? R(1) : cosine.hi < R(-1) ? R(-1) : cosine.hi);
    for (k = 0, done = 0; k < 10 && !done; k++, slack *= R(10)) {
        if (guess - slack > R(0) && cosine_of(guess - slack).lo >= cosine.hi) {
            out.lo = guess - slack;
            done = 1;
        }
    }
    slack = R(SLACK);
    guess = ACOS(cosine.lo > R(1) ? R(1) : cosine.lo < R(-1) ? R(-1) : cosine.lo);
    for (k = 0, done = 0; k < 10 && !done; k++, slack *= R(10)) {
        if (guess + slack < R(PI_BELOW) && cosine_of(guess + slack).hi <= cosine.lo) {
            out.hi = guess + slack;
            done = 1;
        }
    }
    return out;
}

/* The angle with this sine and cosine that is near another one. */
static int angle_near(interval sine, interval cosine, real_t near, interval *out)
{
    if (cosine.lo > R(0.5)) {
        *out = subtract(arc_cosine(point(R(0))), arc_cosine(sine));
        return 1;
    }
    /* the cosine alone tells angles of one sign */
    *out = arc_cosine(cosine);
    if (sine.hi < R(0) && near < R(0)) {
        *out = minus(*out);
        return 1;
    }
    return sine.lo > R(0) && near > R(0);
}

/* The lead per radian is a quotient that was rounded. */
static interval enclosed_lead(const equipod_drives *drives)
{
    return drives->lead == R(0) ? point(R(0)) : span(down(down(drives->lead)), up(up(drives->lead)));
}

static int irates(const equipod_drives *drives, enclosed_leg *leg, interval rates[6])
{
    const interval lead = enclosed_lead(drives);
    interval u[3], m[3], moment[3], far[3], e[2][3], own, other, mixed, offsets, determinant, ua, ub;
    interval first[6], second[6];
    int k;
    if (!iunit(leg->s, u)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        m[k] = subtract(leg->arm[k], multiply(leg->ends[1][k], leg->offset[1]));
        far[k] = subtract(m[k], leg->s[k]);
    }
    icross(m, u, moment);
    for (k = 0; k < 3; k++) {
        rates[k] = u[k];
        rates[k + 3] = moment[k];
    }
    if (is_zero(lead)) {
        return 1;
    }
    icross(leg->axes[0], leg->ends[0], e[0]);
    icross(leg->axes[1], leg->ends[1], e[1]);
    own = add(idot(leg->s, leg->ends[0]), leg->offset[0]);
    other = add(idot(leg->s, leg->ends[1]), leg->offset[1]);
    mixed = idot(e[0], e[1]);
    offsets = multiply(leg->offset[0], leg->offset[1]);
    determinant = subtract(multiply(own, other), multiply(multiply(offsets, mixed), mixed));
    icross(m, e[0], moment);
    for (k = 0; k < 3; k++) {
        first[k] = e[0][k];
        first[k + 3] = moment[k];
    }
    icross(far, e[1], moment);
    for (k = 0; k < 3; k++) {
        second[k] = e[1][k];
        second[k + 3] = moment[k];
    }
    ua = idot(u, leg->axes[0]);
    ub = idot(u, leg->axes[1]);
    for (k = 0; k < 6; k++) {
        interval q, q2, turn;
        if (!divide(subtract(multiply(first[k], other), multiply(multiply(second[k], leg->offset[1]), mixed)), determinant, &q) ||
            !divide(subtract(multiply(second[k], own), multiply(multiply(first[k], leg->offset[0]), mixed)), determinant, &q2)) {
            return 0;
        }
        turn = subtract(multiply(ub, q2), multiply(ua, q));
        if (k >= 3) {
            turn = add(turn, u[k - 3]);
        }
        rates[k] = subtract(rates[k], multiply(lead, turn));
    }
    return 1;
}

/* The length of a drive at the pose itself. */
static int enclosed_drive(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *home, const equipod_pose *pose, int i, real_t twist,
                          interval *out)
{
    neighbourhood at;
    enclosed_leg leg, at_home;
    interval sine[2], cosine[2], turned;
    neighbourhood_of(pose, R(0), R(1), &at);
    if (!enclose(drives, legs, &at, i, &leg) || !root(add(add(square(leg.s[0]), square(leg.s[1])), square(leg.s[2])), out)) {
        return 0;
    }
    if (drives->lead == R(0)) {
        return 1;
    }
    neighbourhood_of(home, R(0), R(1), &at);
    if (!enclose(drives, legs, &at, i, &at_home) || !itwist(&leg, &sine[0], &cosine[0]) || !itwist(&at_home, &sine[1], &cosine[1]) ||
        !angle_near(subtract(multiply(sine[0], cosine[1]), multiply(cosine[0], sine[1])), add(multiply(cosine[0], cosine[1]), multiply(sine[0], sine[1])),
                    twist, &turned)) {
        return 0;
    }
    *out = subtract(*out, multiply(enclosed_lead(drives), turned));
    return 1;
}

/* The largest row sum of I - X H' over a neighbourhood; infinite where nothing is known. */
static real_t contraction_over(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *pose, real_t reach, real_t unit_of_length,
                               real_t inverse[6][6])
{
    neighbourhood at;
    interval slopes[6][6], tilt;
    real_t worst = R(0);
    int i, j, k;
    neighbourhood_of(pose, reach, unit_of_length, &at);
    tilt = about_zero(at.tilt);
    for (i = 0; i < 6; i++) {
        enclosed_leg leg;
        interval rates[6], tilted = point(R(0));
        if (!enclose(drives, legs, &at, i, &leg) || !irates(drives, &leg, rates)) {
            return R(HUGE_VAL);
        }
        for (j = 3; j < 6; j++) {
            tilted = add(tilted, multiply(rates[j], tilt));
        }
        for (k = 0; k < 3; k++) {
            slopes[i][k] = multiply(rates[k], point(unit_of_length));
            slopes[i][k + 3] = add(rates[k + 3], tilted);
        }
    }
    for (i = 0; i < 6; i++) {
        interval sum = point(R(0));
        for (j = 0; j < 6; j++) {
            interval entry = point(R(0));
            for (k = 0; k < 6; k++) {
                entry = add(entry, multiply(point(inverse[i][k]), slopes[k][j]));
            }
            entry = subtract(point(i == j ? R(1) : R(0)), entry);
            sum = add(sum, point(magnitude(entry)));
        }
        worst = sum.hi > worst || !is_finite(sum.hi) ? sum.hi : worst;
    }
    return worst;
}

/* Gauss-Jordan elimination with pivots by rows: an approximate inverse. */
static int invert(real_t a[6][6], real_t out[6][6])
{
    int i, j, k;
    for (i = 0; i < 6; i++) {
        for (j = 0; j < 6; j++) {
            out[i][j] = i == j ? R(1) : R(0);
        }
    }
    for (k = 0; k < 6; k++) {
        int best = k;
        real_t over;
        for (i = k + 1; i < 6; i++) {
            best = FABS(a[i][k]) > FABS(a[best][k]) ? i : best;
        }
        if (!(FABS(a[best][k]) > R(0))) {
            return 0;
        }
        for (j = 0; j < 6; j++) {
            const real_t x = a[k][j], y = out[k][j];
            a[k][j] = a[best][j];
            a[best][j] = x;
            out[k][j] = out[best][j];
            out[best][j] = y;
        }
        over = R(1) / a[k][k];
        for (j = 0; j < 6; j++) {
            a[k][j] *= over;
            out[k][j] *= over;
        }
        for (i = 0; i < 6; i++) {
            const real_t factor = a[i][k];
            for (j = 0; j < 6 && i != k; j++) {
                a[i][j] -= factor * a[k][j];
                out[i][j] -= factor * out[k][j];
            }
        }
    }
    return 1;
}

int equipod_bound_drives(const equipod_drives *drives, const equipod_legs *legs, const equipod_pose *home, const equipod_pose *pose,
                         const real_t lengths[6], equipod_drive_bound *bound)
{
    /* the RMS distance of the platform joints from their mean */
    const real_t unit_of_length = R(0.5) * legs->unit;
    equipod_drive_state state;
    interval missing[6];
    real_t slopes[6][6], inverse[6][6], eta = R(0), reach;
    int i, k, trial;
    if (equipod_drive_states(drives, legs, pose, &state)) {
        return 0;
    }
    for (i = 0; i < 6; i++) {
        interval drive;
        for (k = 0; k < 6; k++) {
            slopes[i][k] = state.rates[i][k] * (k < 3 ? unit_of_length : R(1));
        }
        if (!enclosed_drive(drives, legs, home, pose, i, state.twist[i], &drive)) {
            return 0;
        }
        missing[i] = subtract(drive, point(lengths[i]));
    }
    if (!invert(slopes, inverse)) {
        return 0;
    }
    for (i = 0; i < 6; i++) {
        interval step = point(R(0));
        for (k = 0; k < 6; k++) {
            step = add(step, multiply(point(inverse[i][k]), missing[k]));
        }
        eta = magnitude(step) > eta ? magnitude(step) : eta;
    }
    reach = (eta > R(LEAST) ? eta : R(LEAST)) * R(2);
    for (trial = 0; trial < TRIES; trial++) {
        const real_t kappa = contraction_over(drives, legs, pose, reach, unit_of_length, inverse);
        interval away;
        if (!is_finite(kappa)) {
            return 0;
        }
        /* eta + kappa reach < reach: the Newton map takes the neighbourhood into itself and contracts */
        if (kappa < R(1) && add(point(eta), multiply(point(kappa), point(reach))).hi < reach &&
            divide(point(eta), subtract(point(R(1)), point(kappa)), &away)) {
            bound->angle = multiply(point(away.hi), point(up(R(1.7321)))).hi;
            bound->position = multiply(point(bound->angle), point(unit_of_length)).hi;
            bound->contraction = kappa;
            return 1;
        }
        reach *= R(WIDER);
    }
    return 0;
}

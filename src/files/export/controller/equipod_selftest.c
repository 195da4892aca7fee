/* Compares equipod.c with numbers of the library: bit for bit in double, within the stated bounds in float; covariances of poses to their rounding.
 *
 *     cc -std=c99 -ffp-contract=off equipod.c equipod_design.c equipod_selftest.c -lm -o selftest && ./selftest
 *
 * Exit status 0: all agree. */
#include "equipod.h"
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

typedef struct {
    double rotation[3][3];
    double position[3];
} pose_numbers;

/* Inverse kinematics, Jacobian and margins at a pose. */
typedef struct {
    pose_numbers pose;
    double squares[6], lengths[6], jacobian[6][6];
    double too_short[6], too_long[6], base_cone_angle[6], platform_cone_angle[6];
} inverse_vector;

/* A tracked pose and its evidence. */
typedef struct {
    pose_numbers start;
    double squares[6];
    unsigned segments_allowed;
    int status, reason;
    pose_numbers pose;
    double fraction;
    unsigned segments, newton_steps;
    double kantorovich, frobenius_ratio, residual, distance;
} track_vector;

/* Plain Newton steps. */
typedef struct {
    pose_numbers start;
    double squares[6];
    unsigned steps;
    int regular;
    pose_numbers pose;
} newton_vector;

/* Squares of the machine, those of the octahedral platform with their radii, the octahedral pose and the corrected one. */
typedef struct {
    pose_numbers start;
    double squares[6], mapped[6], radius[6];
    int status;
    pose_numbers pose;
    unsigned corrections;
    pose_numbers corrected;
} map_vector;

#ifdef EQUIPOD_HAS_CALIBRATION
/* Covariance of a computed pose. */
typedef struct {
    pose_numbers pose;
    double covariance[6][6];
} covariance_vector;
#endif

/* The free part of a path. */
typedef struct {
    pose_numbers start;
    double velocity[3], turn[3], most, amount;
    int binds;
} free_vector;

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
    int i, j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            pose.rotation[i][j] = R(numbers->rotation[i][j]);
        }
        pose.position[i] = R(numbers->position[i]);
    }
    return pose;
}

static void squares_from(const double numbers[6], real_t s[6])
{
    int i;
    for (i = 0; i < 6; i++) {
        s[i] = R(numbers[i]);
    }
}

#ifndef EQUIPOD_FLOAT

static int same(real_t ours, double theirs)
{
    return memcmp(&ours, &theirs, sizeof ours) == 0;
}

static int same_list(const real_t *ours, const double *theirs, int count)
{
    int i, all = 1;
    for (i = 0; i < count; i++) {
        all = all && same(ours[i], theirs[i]);
    }
    return all;
}

static int same_pose(const equipod_pose *ours, const pose_numbers *theirs)
{
    return same_list(&ours->rotation[0][0], &theirs->rotation[0][0], 9) && same_list(ours->position, theirs->position, 3);
}

#else

static double size_of(const real_t v[3])
{
    return sqrt((double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] + (double)v[2] * (double)v[2]);
}

/* |a| + |b| + |p| of a leg. */
static double sizes(const equipod_legs *legs, const equipod_pose *pose, int leg)
{
    return size_of(legs->base[leg]) + size_of(legs->platform[leg]) + size_of(pose->position);
}

/* Whether the pose is within its own bounds of error of the other. */
static int within_errors(const equipod_result *ours, const pose_numbers *theirs, double *share)
{
    double turn = 0, shift = 0, size = 0, angle_share, position_share;
    int i, j;
    for (i = 0; i < 3; i++) {
        double d;
        for (j = 0; j < 3; j++) {
            d = (double)ours->pose.rotation[i][j] - theirs->rotation[i][j];
            turn += d * d;
        }
        d = (double)ours->pose.position[i] - theirs->position[i];
        shift += d * d;
        size += theirs->position[i] * theirs->position[i];
    }
    /* |R - R'| = 2 sqrt 2 sin(angle / 2), and the entries are rounded */
    angle_share = sqrt(turn / 2) / ((double)ours->angle_error + EPSILON);
    position_share = sqrt(shift) / ((double)ours->position_error + EPSILON * sqrt(size));
    if (angle_share > *share) {
        *share = angle_share;
    }
    if (position_share > *share) {
        *share = position_share;
    }
    return angle_share <= 1 && position_share <= 1;
}

#endif

static int near(real_t ours, double theirs, double bound)
{
    return (isinf(theirs) && isinf((double)ours)) || fabs((double)ours - theirs) <= bound;
}

static void check_margins(const inverse_vector *v, const equipod_pose *pose, unsigned number)
{
    equipod_margins m;
    int i;
    equipod_limit_margins(&equipod_design_limits, &equipod_nominal, pose, &m);
    for (i = 0; i < 6; i++) {
        double length = v->lengths[i];
#ifdef EQUIPOD_FLOAT
        const double bound = 16 * (EPSILON / 2) * (sizes(&equipod_nominal, pose, i) + length);
#else
        const double bound = 64 * (EPSILON / 2) * length + EPSILON * fabs(v->too_long[i] < 1e300 ? v->too_long[i] : 0);
#endif
        /* an angle is off by the error of the leg over its length, and by that of the axis */
        const double angle = 57.3 * (4 * bound / length + 1e2 * EPSILON);
        check(near(m.too_short[i], v->too_short[i], bound), "margin of the least length", number);
        check(near(m.too_long[i], v->too_long[i], bound), "margin of the greatest length", number);
        check(near(m.base_cone_angle_degrees[i], v->base_cone_angle[i], angle), "cone angle at the base", number);
        check(near(m.platform_cone_angle_degrees[i], v->platform_cone_angle[i], angle), "cone angle at the platform", number);
    }
}

static void check_inverse(void)
{
    unsigned n;
    for (n = 0; n < COUNT(inverse_vectors); n++) {
        const inverse_vector *v = &inverse_vectors[n];
        const equipod_pose pose = pose_from(&v->pose);
        real_t s[6], l[6], j[6][6], angles[3];
        equipod_pose again;
        int i, k;
        double off = 0;
        equipod_squared_lengths(&equipod_nominal, &pose, s);
        equipod_lengths(&equipod_nominal, &pose, l);
        check(equipod_jacobian(&equipod_nominal, &pose, j) == 1, "legs have directions", n);
#ifdef EQUIPOD_FLOAT
        for (i = 0; i < 6; i++) {
            const double bound = 16 * (EPSILON / 2) * sizes(&equipod_nominal, &pose, i);
            check(near(s[i], v->squares[i], 2.1 * bound * (v->lengths[i] + bound)), "squared length", n);
            check(near(l[i], v->lengths[i], bound), "length", n);
            for (k = 0; k < 6; k++) {
                const double arm = k < 3 ? 1 : size_of(equipod_nominal.platform[i]);
                check(near(j[i][k], v->jacobian[i][k], 2.5 * bound / v->lengths[i] * arm), "Jacobian", n);
            }
        }
#else
        check(same_list(s, v->squares, 6), "squared lengths", n);
        check(same_list(l, v->lengths, 6), "lengths", n);
        check(same_list(&j[0][0], &v->jacobian[0][0], 36), "Jacobian", n);
#endif
        equipod_angles(&pose, angles);
        equipod_pose_from_angles(pose.position, angles, &again);
        for (i = 0; i < 3; i++) {
            for (k = 0; k < 3; k++) {
                off = fmax(off, fabs((double)again.rotation[i][k] - (double)pose.rotation[i][k]));
            }
        }
        check(off <= 16 * EPSILON, "angles there and back", n);
        check_margins(v, &pose, n);
    }
}

static void check_tracked(void)
{
    unsigned n, tracked = 0;
#ifdef EQUIPOD_FLOAT
    unsigned refused = 0;
    double share = 0;
#endif
    for (n = 0; n < COUNT(track_vectors); n++) {
        const track_vector *v = &track_vectors[n];
        const equipod_pose start = pose_from(&v->start);
        real_t s[6];
        equipod_result r;
        squares_from(v->squares, s);
        equipod_track(&equipod_nominal, s, 0, &start, R(EQUIPOD_SINGULAR), v->segments_allowed, &r);
        tracked += r.status == EQUIPOD_TRACKED;
        check(r.segments <= v->segments_allowed, "segments within their bound", n);
#ifdef EQUIPOD_FLOAT
        /* float may need more segments, or refuse where rounding hides a singularity; it must not claim what is not there.
           Rounding counts by the square of the ratio in the test, so that float ends where the ratio is some hundredth. */
        if (r.status == EQUIPOD_TRACKED) {
            check(v->status == EQUIPOD_TRACKED || v->reason == EQUIPOD_SEGMENTS_EXHAUSTED, "tracked only what can be", n);
            if (v->status == EQUIPOD_TRACKED) {
                check(within_errors(&r, &v->pose, &share), "pose within its bounds", n);
            }
        } else if (v->status == EQUIPOD_TRACKED) {
            refused += 1;
            check(v->frobenius_ratio < 1e-2 || v->segments > v->segments_allowed / 2, "tracked where the library tracks with a large margin", n);
        }
#else
        check((int)r.status == v->status && (int)r.reason == v->reason, "status", n);
        check(same_pose(&r.pose, &v->pose), "tracked pose", n);
        check(same(r.fraction, v->fraction), "fraction", n);
        check(r.segments == v->segments && r.newton_steps == v->newton_steps, "segments and steps", n);
        check(same(r.kantorovich, v->kantorovich), "Kantorovich number", n);
        check(same(r.frobenius_ratio, v->frobenius_ratio), "condition", n);
        check(same(r.residual, v->residual) && same(r.distance, v->distance), "residual and distance", n);
        check(r.status != EQUIPOD_TRACKED || r.position_error < R(INFINITY) || v->frobenius_ratio < 1e-5, "bound of the error", n);
#endif
    }
    printf("%u of %u paths tracked to the end\n", tracked, (unsigned)COUNT(track_vectors));
#ifdef EQUIPOD_FLOAT
    printf("%u of them refused in float; the greatest error is %.3f of its bound\n", refused, share);
#endif
}

static void check_newton(void)
{
    unsigned n;
    for (n = 0; n < COUNT(newton_vectors); n++) {
        const newton_vector *v = &newton_vectors[n];
        const equipod_pose start = pose_from(&v->start);
        equipod_pose pose;
        real_t s[6];
        squares_from(v->squares, s);
        check(equipod_newton_steps(&equipod_nominal, s, &start, v->steps, &pose) == v->regular, "regular for Newton's method", n);
#ifndef EQUIPOD_FLOAT
        check(!v->regular || same_pose(&pose, &v->pose), "Newton steps", n);
#endif
    }
}

#ifdef EQUIPOD_HAS_OCTAHEDRAL
static void check_mapped(void)
{
    unsigned n;
#ifdef EQUIPOD_FLOAT
    double share = 0;
#endif
    for (n = 0; n < COUNT(map_vectors); n++) {
        const map_vector *v = &map_vectors[n];
        const equipod_pose start = pose_from(&v->start);
        real_t s[6], to[6], radius[6];
        equipod_result r;
#ifndef EQUIPOD_FLOAT
        equipod_result own;
#endif
        squares_from(v->squares, s);
        check(equipod_map_squares(&equipod_to_octahedral, s, to, radius) == 0, "squares of the octahedral platform", n);
#ifdef EQUIPOD_FLOAT
        {
            int i;
            for (i = 0; i < 6; i++) {
                check(near(to[i], v->mapped[i], (double)radius[i]), "mapped squares within their radii", n);
            }
        }
        /* the squares at hand are rounded themselves, which the corrected pose takes up: its bound is that of the machine's own joints */
        equipod_track_mapped(&equipod_to_octahedral, &equipod_octahedral, &equipod_nominal, s, &start, R(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS,
                             v->corrections, &r);
        if (r.status == EQUIPOD_TRACKED) {
            check(within_errors(&r, &v->corrected, &share), "corrected pose within its bounds", n);
        }
#else
        check(same_list(to, v->mapped, 6) && same_list(radius, v->radius, 6), "mapped squares", n);
        equipod_track_mapped(&equipod_to_octahedral, &equipod_octahedral, &equipod_nominal, s, &start, R(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS,
                             0, &r);
        check((int)r.status == v->status && same_pose(&r.pose, &v->pose), "octahedral pose", n);
        equipod_track_mapped(&equipod_to_octahedral, &equipod_octahedral, &equipod_nominal, s, &start, R(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS,
                             v->corrections, &r);
        /* where the joints do not prove the corrected pose, the pose is the one that is tracked on them */
        equipod_track(&equipod_nominal, s, 0, &start, R(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS, &own);
        check((v->status == EQUIPOD_TRACKED && same_pose(&r.pose, &v->corrected)) || memcmp(&r.pose, &own.pose, sizeof own.pose) == 0,
              "corrected pose", n);
#endif
    }
}
#endif

/* A path ends where the library says; in float, where limits are met and beyond are not. */
static void check_free(void)
{
    unsigned n;
    for (n = 0; n < COUNT(free_vectors); n++) {
        const free_vector *v = &free_vectors[n];
        const equipod_pose start = pose_from(&v->start);
        const real_t most = (real_t)v->most;
        real_t velocity[3], turn[3];
        equipod_travel travel;
        equipod_margins margins;
        int i;
        if (!(v->most > 0)) {
            continue;
        }
        for (i = 0; i < 3; i++) {
            velocity[i] = (real_t)v->velocity[i];
            turn[i] = (real_t)v->turn[i];
        }
        check(equipod_free_path(&equipod_design_limits, &equipod_nominal, &start, velocity, turn, most, 2000, &travel) == 1, "start of a path", n);
        equipod_limit_margins(&equipod_design_limits, &equipod_nominal, &travel.pose, &margins);
        check(margins.met, "limits at the end of a path", n);
        check(travel.poses <= 2000, "poses within their bound", n);
        check(near(travel.amount, v->amount, (sizeof(real_t) == sizeof(double) ? 1e-6 : 1e-2) * v->most), "free part of a path", n);
#ifndef EQUIPOD_FLOAT
        check(travel.binds == v->binds, "end of a path", n);
#endif
        check(!travel.binds || travel.leg >= 0, "what binds", n);
        equipod_free_path(&equipod_design_limits, &equipod_nominal, &start, velocity, turn, most, 3, &travel);
        check(travel.poses <= 3 && travel.amount <= most, "few poses", n);
    }
}

/* The design made ready here is the design made ready by the library, but for rounding; a coordinate that is no number is refused. */
static void check_prepared(void)
{
    equipod_legs legs = equipod_nominal;
    double off = 0;
    int i, k, good;
    legs.base[2][1] = R(NAN);
    good = equipod_prepare((const real_t(*)[3])legs.base, equipod_nominal.platform, &legs) == 0;
    check(good && equipod_prepare(equipod_nominal.base, equipod_nominal.platform, &legs) == 1, "joints that have a size", 0);
    for (i = 0; i < 6; i++) {
        for (k = 0; k < 3; k++) {
            off = fmax(off, fabs((double)(legs.reduced_base[i][k] - equipod_nominal.reduced_base[i][k])));
            off = fmax(off, fabs((double)(legs.reduced_platform[i][k] - equipod_nominal.reduced_platform[i][k])));
        }
    }
    check(off <= 1e3 * EPSILON, "joints made ready", 0);
}

#ifdef EQUIPOD_HAS_CALIBRATION
/* Entries over the deviations of their rows and columns, which have no unit. */
static void check_covariance(void)
{
    unsigned n;
    for (n = 0; n < COUNT(covariance_vectors); n++) {
        const covariance_vector *v = &covariance_vectors[n];
        const equipod_pose pose = pose_from(&v->pose);
        real_t found[6][6];
        int i, j, good = equipod_pose_covariance(&equipod_nominal, &pose, equipod_calibration, found);
        for (i = 0; good && i < 6; i++) {
            for (j = 0; j < 6; j++) {
                const double unit = sqrt(v->covariance[i][i] * v->covariance[j][j]);
                good = good && fabs((double)found[i][j] - v->covariance[i][j]) <= 1e5 * EPSILON * unit;
            }
        }
        check(good, "covariance of a pose", n);
    }
}
#endif

int main(void)
{
#if !defined(EQUIPOD_FLOAT) && defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
    printf("this processor evaluates in another precision: bits will differ\n");
#endif
    check_prepared();
    check_inverse();
    check_tracked();
    check_newton();
    check_free();
#ifdef EQUIPOD_HAS_CALIBRATION
    check_covariance();
#endif
#ifdef EQUIPOD_HAS_OCTAHEDRAL
    check_mapped();
#endif
    printf("%s: %u checks, %u failed\n", sizeof(real_t) == sizeof(double) ? "double, bit for bit" : "float, within bounds", checks, failures);
    return failures == 0 ? 0 : 1;
}

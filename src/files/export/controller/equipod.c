/* Kinematics of Gough-Stewart platforms for controllers, see equipod.h.
 *
 * In double every number is that of the library, bit for bit: the operations are the same in the same order. This holds where the compiler
 * neither contracts products and sums (GCC: -ffp-contract=off, the default of -std=c99) nor reorders them, and evaluates in the type written
 * (FLT_EVAL_METHOD 0: not on the x87). The proofs need no more than that each operation rounds correctly to real_t. */
#include "equipod.h"

#include <float.h>
#include <math.h>

#ifdef __FAST_MATH__
#error "equipod.c: the tests are proofs only where operations keep their order; compile without -ffast-math"
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

#define R(x) ((real_t)(x))

#ifdef EQUIPOD_FLOAT
#define SQRT sqrtf
#define FABS fabsf
#define SIN sinf
#define COS cosf
#define ATAN2 atan2f
#define EPSILON FLT_EPSILON
#define LEAST FLT_MIN
#define GREATEST FLT_MAX
/* Newton's method ends when what is left is a hundredth of a rounding. */
#define CONVERGED 5e-10
/* How far a matrix may be from a rotation. */
#define ROTATION 1e-5
/* What takes up the rounding of fewer than a thousand operations on numbers that are not negative, 8192 units. */
#define UP (R(1) + R(1) / R(2048))
#define PROVED (R(1) - R(1) / R(4096))
#define NEARLY (R(1) + R(1e-4))
#else
#define SQRT sqrt
#define FABS fabs
#define SIN sin
#define COS cos
#define ATAN2 atan2
#define EPSILON DBL_EPSILON
#define LEAST DBL_MIN
#define GREATEST DBL_MAX
#define CONVERGED 1e-18
#define ROTATION 1e-6
#define UP (R(1) + R(1) / R(1099511627776.0))
#define PROVED (R(1) - R(1) / R(1073741824.0))
#define NEARLY (R(1) + R(1e-9))
#endif

/* A rounding is at most U of the result. */
#define U (R(EPSILON) / R(2))
/* The Kantorovich number 4 (beta + eta) eta aimed at for a segment; the theorem needs 1. */
#define KANTOROVICH 0.88
/* Rounding of the distance of two poses, in the solver's units. */
#ifdef EQUIPOD_FLOAT
#define ROUNDING 5.4e-6
#else
#define ROUNDING 1e-14
#endif
#define ROOT_TWO 1.41421356237309504880
#define DEGREES 57.29577951308232

typedef real_t matrix6[6][6];

typedef struct {
    real_t rotation[3][3];
    real_t position[3];
} place_t;

static int is_nan(real_t x)
{
    return x != x;
}

static int is_finite(real_t x)
{
    return FABS(x) <= R(GREATEST);
}

/* The larger number, the other one where one is not a number. */
static real_t larger(real_t x, real_t y)
{
    if (is_nan(x)) {
        return y;
    }
    return y > x ? y : x;
}

static real_t smaller(real_t x, real_t y)
{
    if (is_nan(x)) {
        return y;
    }
    return y < x ? y : x;
}

static real_t dot(const real_t a[3], const real_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static real_t norm(const real_t a[3])
{
    return SQRT(dot(a, a));
}

static void cross(const real_t a[3], const real_t b[3], real_t out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Square root of the sum of squares, in order. */
static real_t root_of_squares(const real_t *x, int count)
{
    real_t sum = -R(0);
    int i;
    for (i = 0; i < count; i++) {
        sum += x[i] * x[i];
    }
    return SQRT(sum);
}

/* max(|h|, |w|) of a step (h, w), not a number when one is. */
static real_t step_size(const real_t step[6])
{
    const real_t h = norm(step), w = norm(step + 3);
    if (is_nan(h)) {
        return h;
    }
    if (is_nan(w)) {
        return w;
    }
    return larger(h, w);
}

/* ---- the leg equations about a pose -------------------------------------------------------------------------------------------------
 * With the pose as frame B = R b, A = a - q, D = B - A (q the mean of the platform joints, lengths over the unit), and a pose nearby as a dual
 * quaternion (1, w; g0, h):
 *     f_i = (D.D - s) / 2,   f_i(w, h, g0) = f_i + D.h + 2 (B x D).w + Q_i,   f_7 = g0 + w.h,
 * exactly, with Q_i quadratic. */

typedef struct {
    real_t a[6][3], b[6][3], d[6][3];
    real_t f[6], squares[6];
} local_t;

static void local_at(const equipod_legs *legs, const place_t *place, const real_t target[6], local_t *out)
{
    int i, k;
    for (i = 0; i < 6; i++) {
        for (k = 0; k < 3; k++) {
            out->b[i][k] = dot(place->rotation[k], legs->reduced_platform[i]);
            out->a[i][k] = legs->reduced_base[i][k] - place->position[k];
            out->d[i][k] = out->b[i][k] - out->a[i][k];
        }
        out->squares[i] = dot(out->d[i], out->d[i]);
        out->f[i] = R(0.5) * (out->squares[i] - target[i]);
    }
}

/* Rows [D, 2 B x D]. */
static void local_jacobian(const local_t *here, matrix6 j)
{
    int i, k;
    for (i = 0; i < 6; i++) {
        real_t m[3];
        cross(here->b[i], here->d[i], m);
        for (k = 0; k < 3; k++) {
            j[i][k] = here->d[i][k];
            j[i][k + 3] = R(2) * m[k];
        }
    }
}

/* Row of the largest entry of a column at or below the diagonal; -1 when it is zero or not a number. */
static int pivot(matrix6 j, int k)
{
    int best = k, i;
    for (i = k + 1; i < 6; i++) {
        if (FABS(j[i][k]) > FABS(j[best][k])) {
            best = i;
        }
    }
    return FABS(j[best][k]) > R(0) ? best : -1;
}

static void swap_rows(matrix6 m, int p, int q)
{
    int l;
    for (l = 0; l < 6; l++) {
        const real_t t = m[p][l];
        m[p][l] = m[q][l];
        m[q][l] = t;
    }
}

/* Solves j x = x by Gaussian elimination with partial pivoting. */
static int eliminate(matrix6 j, real_t x[6])
{
    int i, k, l;
    for (k = 0; k < 6; k++) {
        const int p = pivot(j, k);
        real_t inverse, t;
        if (p < 0) {
            return 0;
        }
        swap_rows(j, k, p);
        t = x[k];
        x[k] = x[p];
        x[p] = t;
        inverse = R(1) / j[k][k];
        for (i = k + 1; i < 6; i++) {
            const real_t factor = j[i][k] * inverse;
            for (l = k + 1; l < 6; l++) {
                j[i][l] -= factor * j[k][l];
            }
            x[i] -= factor * x[k];
        }
    }
    for (k = 5; k >= 0; k--) {
        for (l = k + 1; l < 6; l++) {
            x[k] -= j[k][l] * x[l];
        }
        x[k] /= j[k][k];
    }
    return 1;
}

/* Gauss-Jordan elimination with partial pivoting: y <- j^-1 y. */
static int invert(matrix6 j, matrix6 y)
{
    int i, k, l;
    for (k = 0; k < 6; k++) {
        const int p = pivot(j, k);
        real_t inverse;
        if (p < 0) {
            return 0;
        }
        swap_rows(j, k, p);
        swap_rows(y, k, p);
        inverse = R(1) / j[k][k];
        for (l = 0; l < 6; l++) {
            j[k][l] *= inverse;
            y[k][l] *= inverse;
        }
        for (i = 0; i < 6; i++) {
            real_t factor;
            if (i == k) {
                continue;
            }
            factor = j[i][k];
            for (l = 0; l < 6; l++) {
                j[i][l] -= factor * j[k][l];
                y[i][l] -= factor * y[k][l];
            }
        }
    }
    return 1;
}

/* The Newton step (h, w); 0 where the Jacobian is singular. */
static int newton(const local_t *here, real_t step[6])
{
    matrix6 j;
    int i;
    local_jacobian(here, j);
    for (i = 0; i < 6; i++) {
        step[i] = -here->f[i];
    }
    return eliminate(j, step);
}

/* R (3 I - R^T R) / 2: squares the defect of R^T R = I. */
static void reorthogonalise(place_t *place)
{
    real_t c[3][3], xy, xz, yz, xx, yy, zz;
    int i, j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            c[j][i] = place->rotation[i][j];
        }
    }
    xy = R(0.5) * dot(c[0], c[1]);
    xz = R(0.5) * dot(c[0], c[2]);
    yz = R(0.5) * dot(c[1], c[2]);
    xx = R(1.5) - R(0.5) * dot(c[0], c[0]);
    yy = R(1.5) - R(0.5) * dot(c[1], c[1]);
    zz = R(1.5) - R(0.5) * dot(c[2], c[2]);
    for (i = 0; i < 3; i++) {
        real_t *r = place->rotation[i];
        const real_t x = r[0], y = r[1], z = r[2];
        r[0] = x * xx - y * xy - z * xz;
        r[1] = y * yy - x * xy - z * yz;
        r[2] = z * zz - x * xz - y * yz;
    }
}

/* R <- Cay(w) R, q <- q + (h + w x h + (w.h) w) / (1 + w.w). */
static void apply_step(const real_t step[6], place_t *place)
{
    const real_t *h = step, *w = step + 3;
    const real_t ww = dot(w, w), wh = dot(w, h);
    const real_t x = w[0], y = w[1], z = w[2];
    const real_t scale = R(1) / (R(1) + ww);
    real_t turn[3], cay[3][3], r[3][3];
    int i, j, k;
    cross(w, h, turn);
    for (k = 0; k < 3; k++) {
        place->position[k] += (h[k] + turn[k] + wh * w[k]) * scale;
    }
    cay[0][0] = R(1) - ww + R(2) * x * x;
    cay[0][1] = R(2) * (x * y - z);
    cay[0][2] = R(2) * (x * z + y);
    cay[1][0] = R(2) * (x * y + z);
    cay[1][1] = R(1) - ww + R(2) * y * y;
    cay[1][2] = R(2) * (y * z - x);
    cay[2][0] = R(2) * (x * z - y);
    cay[2][1] = R(2) * (y * z + x);
    cay[2][2] = R(1) - ww + R(2) * z * z;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            r[i][j] = (cay[i][0] * place->rotation[0][j] + cay[i][1] * place->rotation[1][j] + cay[i][2] * place->rotation[2][j]) * scale;
        }
    }
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            place->rotation[i][j] = r[i][j];
        }
    }
    reorthogonalise(place);
}

/* Makes the matrix a rotation; 0 for what is none, mirror images included. */
static int make_rotation(place_t *place)
{
    real_t worst = R(0), c[3];
    int i, j, finite;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            const real_t error = FABS(dot(place->rotation[i], place->rotation[j]) - (i == j ? R(1) : R(0)));
            worst = is_nan(error) ? error : larger(worst, error);
        }
    }
    cross(place->rotation[0], place->rotation[1], c);
    finite = is_finite(place->position[0]) && is_finite(place->position[1]) && is_finite(place->position[2]);
    if (!(worst <= R(ROTATION)) || !(dot(c, place->rotation[2]) > R(0)) || !finite) {
        return 0;
    }
    reorthogonalise(place);
    reorthogonalise(place);
    return 1;
}

/* Entry (i, j) of the turn that takes the first place to the second. */
static real_t turn_entry(const place_t *from, const place_t *to, int i, int j)
{
    return dot(to->rotation[i], from->rotation[j]);
}

/* max(|w|, |h|, |g0| / epsilon) of the second place seen from the first; infinite for half a turn. */
static real_t place_distance(const place_t *from, const place_t *to, real_t epsilon)
{
    const real_t trace = R(1) + turn_entry(from, to, 0, 0) + turn_entry(from, to, 1, 1) + turn_entry(from, to, 2, 2);
    real_t w[3], p[3], turn[3], h[3], all[3];
    int k;
    w[0] = (turn_entry(from, to, 2, 1) - turn_entry(from, to, 1, 2)) / trace;
    w[1] = (turn_entry(from, to, 0, 2) - turn_entry(from, to, 2, 0)) / trace;
    w[2] = (turn_entry(from, to, 1, 0) - turn_entry(from, to, 0, 1)) / trace;
    for (k = 0; k < 3; k++) {
        p[k] = to->position[k] - from->position[k];
    }
    cross(p, w, turn);
    for (k = 0; k < 3; k++) {
        h[k] = p[k] + turn[k];
    }
    all[0] = norm(w);
    all[1] = norm(h);
    all[2] = FABS(dot(p, w)) / epsilon;
    if (!(trace > R(0)) || !is_finite(all[0]) || !is_finite(all[1]) || !is_finite(all[2])) {
        return R(INFINITY);
    }
    return larger(larger(larger(R(0), all[0]), all[1]), all[2]);
}

/* ---- bounds of the rounding ---------------------------------------------------------------------------------------------------------
 * Error bounds of the numbers of a local_t against the exact problem: the joints within their radii, the rotation nearest to the matrix,
 * squares within target_error. First order in U, constants rounded up. */

typedef struct {
    real_t a[6], b[6], d[6], f[6];
    real_t turn;
} blur_t;

static void blur_of(const equipod_legs *legs, const place_t *place, const local_t *here, const real_t target_error[6], blur_t *out)
{
    real_t square = R(0);
    int i, j, k;
    for (j = 0; j < 3; j++) {
        for (k = 0; k < 3; k++) {
            real_t product = -R(0), defect;
            for (i = 0; i < 3; i++) {
                product += place->rotation[i][j] * place->rotation[i][k];
            }
            defect = FABS(product - (j == k ? R(1) : R(0))) + R(4) * U;
            square += defect * defect;
        }
    }
    out->turn = SQRT(square) * UP;
    for (i = 0; i < 6; i++) {
        const real_t length = norm(here->d[i]);
        const real_t b = ((out->turn + R(10) * U) * norm(legs->reduced_platform[i]) + legs->loose_platform[i]) * UP;
        const real_t a = (R(2.5) * U * norm(legs->reduced_base[i]) + R(1.5) * U * norm(here->a[i]) + legs->loose_base[i]) * UP;
        const real_t d = (a + b + R(1.5) * U * length) * UP;
        const real_t own = R(6) * U * here->squares[i] + R(2) * U * FABS(here->f[i]);
        const real_t f = (length * d + R(0.5) * d * d + own + R(0.5) * target_error[i]) * UP;
        out->a[i] = a;
        out->b[i] = b;
        out->d[i] = d;
        out->f[i] = f;
    }
}

/* Of a row of the Jacobian, and seven roundings of a sum over six such rows. */
static real_t blur_row(const blur_t *blur, const local_t *here, int i)
{
    const real_t b = norm(here->b[i]), d = norm(here->d[i]);
    const real_t turned = R(2) * (blur->b[i] * d + b * blur->d[i] + blur->b[i] * blur->d[i]);
    return (blur->d[i] + turned + R(10) * U * b * d + R(8) * U * (d + R(2) * b * d)) * UP;
}

/* Of the coefficients of Q_i without those of g0 D.w, and of the latter. */
static void blur_second_order(const blur_t *blur, const local_t *here, int i, real_t *of_free, real_t *of_linear)
{
    const real_t a = norm(here->a[i]), b = norm(here->b[i]);
    const real_t own = R(10) * U * (R(1) + a + b + R(6) * a * b);
    const real_t change = blur->a[i] + blur->b[i] + R(6) * (blur->a[i] * b + a * blur->b[i] + blur->a[i] * blur->b[i]);
    *of_free = (change + own) * UP;
    *of_linear = (blur->d[i] + R(10) * U * norm(here->d[i])) * UP;
}

/* ---- the Kantorovich test -----------------------------------------------------------------------------------------------------------*/

typedef struct {
    real_t step[6];         /* the Newton step to the end of the path */
    real_t eta;             /* bound of its size */
    real_t slack;           /* the part of eta that is there at the beginning of the path too */
    real_t beta;            /* bound of |Y Q| without the part of f; at least 1 */
    real_t epsilon;         /* weight of g0 in the norm */
    real_t frobenius_ratio;
} start_t;

static real_t bound(const real_t linear[6], const real_t unit[6], const real_t of_free[6], real_t epsilon)
{
    real_t row[6];
    int k;
    for (k = 0; k < 6; k++) {
        row[k] = of_free[k] + epsilon * (linear[k] + epsilon * unit[k]);
    }
    {
        const real_t h = root_of_squares(row, 3), w = root_of_squares(row + 3, 3);
        if (is_nan(h)) {
            return h;
        }
        if (is_nan(w)) {
            return w;
        }
        return larger(h, w);
    }
}

/* beta and epsilon: rows of Y Q are combined over the legs first, then bounded, in blocks of three by the Euclidean norm. */
static void second_order(const local_t *here, matrix6 y, const blur_t *blur, real_t *beta, real_t *epsilon)
{
    real_t terms[6][13], of_free[6], of_linear[6], all[6], unit[6], linear[6];
    real_t weight;
    int i, k, l;
    for (i = 0; i < 6; i++) {
        const real_t *a = here->a[i], *b = here->b[i], *d = here->d[i];
        const real_t two_ab = R(2) * dot(a, b);
        real_t *t = terms[i];
        t[0] = R(1);
        for (k = 0; k < 3; k++) {
            t[1 + k] = d[k];
            t[4 + k] = a[k] + b[k];
            t[7 + k] = two_ab - R(2) * a[k] * b[k];
        }
        t[10] = a[0] * b[1] + a[1] * b[0];
        t[11] = a[0] * b[2] + a[2] * b[0];
        t[12] = a[1] * b[2] + a[2] * b[1];
        blur_second_order(blur, here, i, &of_free[i], &of_linear[i]);
    }
    for (k = 0; k < 6; k++) {
        real_t c[13], near_diagonal = -R(0), off_diagonal = -R(0);
        for (l = 0; l < 13; l++) {
            c[l] = R(0);
        }
        for (i = 0; i < 6; i++) {
            for (l = 0; l < 13; l++) {
                c[l] += y[k][i] * terms[i][l];
            }
        }
        unit[k] = R(0.5) * FABS(c[0]);
        linear[k] = root_of_squares(c + 1, 3);
        for (l = 7; l < 10; l++) {
            near_diagonal += c[l] * c[l];
        }
        for (l = 10; l < 13; l++) {
            off_diagonal += c[l] * c[l];
        }
        all[k] = unit[k] + root_of_squares(c + 4, 3) + SQRT(near_diagonal + R(2) * off_diagonal);
        for (i = 0; i < 6; i++) {
            weight = FABS(y[k][i]);
            all[k] += weight * of_free[i];
            linear[k] += weight * of_linear[i];
            unit[k] += weight * R(8) * U;
        }
    }
    *epsilon = R(1) / larger(bound(linear, unit, all, R(0)), R(1));
    *beta = bound(linear, unit, all, *epsilon);
    if (!is_nan(*beta)) {
        *beta = larger(*beta, R(1) / *epsilon);
    }
}

/* 0 where the Jacobian is singular or a bound says nothing. */
static int start_of(const local_t *here, const blur_t *blur, start_t *out)
{
    matrix6 j, y, work;
    real_t rows[6], steps[6], defects[6], kappa, denominator, beta;
    int i, k, l;
    local_jacobian(here, j);
    for (i = 0; i < 6; i++) {
        for (k = 0; k < 6; k++) {
            work[i][k] = j[i][k];
            y[i][k] = i == k ? R(1) : R(0);
        }
    }
    if (!invert(work, y)) {
        return 0;
    }
    for (k = 0; k < 6; k++) {
        real_t sum = -R(0);
        for (i = 0; i < 6; i++) {
            sum += y[k][i] * here->f[i];
        }
        out->step[k] = -sum;
    }
    out->frobenius_ratio = R(6) / (root_of_squares(&j[0][0], 36) * root_of_squares(&y[0][0], 36));
    for (i = 0; i < 6; i++) {
        rows[i] = blur_row(blur, here, i);
        steps[i] = R(0);
        defects[i] = R(0);
    }
    for (k = 0; k < 6; k++) {
        real_t left[6];
        for (l = 0; l < 6; l++) {
            left[l] = l == k ? R(1) : R(0);
        }
        for (i = 0; i < 6; i++) {
            for (l = 0; l < 6; l++) {
                left[l] -= y[k][i] * j[i][l];
            }
            steps[k] += FABS(y[k][i]) * (blur->f[i] + R(8) * U * FABS(here->f[i]));
            defects[k] += FABS(y[k][i]) * rows[i];
        }
        defects[k] += root_of_squares(left, 6) + R(2) * U;
    }
    /* in the norm max(|h|, |w|) a row acts by at most sqrt 2 times its Euclidean norm */
    kappa = R(ROOT_TWO) * step_size(defects) * UP;
    denominator = (R(1) - kappa) * (R(1) - kappa) * (R(2) - UP);
    out->slack = step_size(steps) * UP / denominator;
    out->eta = step_size(out->step) * UP / denominator + out->slack;
    second_order(here, y, blur, &beta, &out->epsilon);
    out->beta = beta * UP / denominator;
    return is_finite(out->eta) && is_finite(out->beta) && is_finite(out->frobenius_ratio) && kappa < R(0.5);
}

/* ---- following a pose ---------------------------------------------------------------------------------------------------------------*/

static void place_of(const equipod_legs *legs, const equipod_pose *pose, place_t *place)
{
    int i, j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            place->rotation[i][j] = pose->rotation[i][j];
        }
        place->position[i] = (dot(pose->rotation[i], legs->centre) + pose->position[i] - legs->origin[i]) / legs->unit;
    }
}

static void pose_of(const equipod_legs *legs, const place_t *place, equipod_pose *pose)
{
    int i, j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            pose->rotation[i][j] = place->rotation[i][j];
        }
        pose->position[i] = place->position[i] * legs->unit + legs->origin[i] - dot(place->rotation[i], legs->centre);
    }
}

/* Squares in the solver's units, and how far from these those asked for may be. */
static void target_of(const equipod_legs *legs, const real_t s[6], const real_t *radius, real_t target[6], real_t target_error[6])
{
    const real_t scale = R(1) / (legs->unit * legs->unit);
    int i;
    for (i = 0; i < 6; i++) {
        target[i] = s[i] * scale;
        target_error[i] = (R(4) * R(EPSILON) * target[i] + (radius ? radius[i] : R(0)) * scale) * NEARLY + R(LEAST);
    }
}

/* Whether a place is in the ball about `centre` in which 2 beta |x| < 1: every pose of it is regular, and no two have the same lengths. */
static int ball_holds(const place_t *centre, real_t beta, real_t epsilon, const place_t *place)
{
    const real_t radius = place_distance(centre, place, epsilon);
    real_t rounding, greatest = R(0);
    int k;
    for (k = 0; k < 3; k++) {
        greatest = larger(greatest, FABS(centre->position[k]));
    }
    for (k = 0; k < 3; k++) {
        greatest = larger(greatest, FABS(place->position[k]));
    }
    rounding = R(ROUNDING) * (R(1) + greatest);
    return R(2) * beta * (radius + rounding / epsilon) <= PROVED;
}

/* Newton's method to the root for `target` in the Kantorovich ball about `place`; 0 when it ends elsewhere. */
static int correct(const equipod_legs *legs, const real_t target[6], const start_t *start, real_t part, place_t *place, unsigned *steps)
{
    const real_t beta = start->beta + part * start->eta + start->slack;
    const place_t from = *place;
    real_t step[6];
    unsigned n;
    int k;
    for (k = 0; k < 6; k++) {
        step[k] = part * start->step[k];
    }
    for (n = 0; n < EQUIPOD_CORRECTIONS; n++) {
        const real_t size = step_size(step);
        local_t here;
        if (!(size > R(0))) {
            break;
        }
        apply_step(step, place);
        *steps += 1;
        /* the error left is at most 2 beta size^2 */
        if (R(4) * beta * size * size < R(CONVERGED)) {
            break;
        }
        local_at(legs, place, target, &here);
        if (!newton(&here, step)) {
            return 0;
        }
    }
    return ball_holds(&from, beta, start->epsilon, place);
}

typedef enum { ARRIVED, ADVANCED, SINGULAR, STUCK } segment_end;

/* One segment towards `target`, as far as the Kantorovich test proves it free of singularities. */
static segment_end segment(const equipod_legs *legs, const real_t target[6], const real_t target_error[6], real_t singular, place_t *place,
                           real_t *taken, equipod_result *result)
{
    local_t here;
    blur_t blur;
    start_t start;
    real_t number, part, eta, between[6];
    place_t next = *place;
    int i;
    local_at(legs, place, target, &here);
    blur_of(legs, place, &here, target_error, &blur);
    if (!start_of(&here, &blur, &start) || !(start.frobenius_ratio >= singular)) {
        return SINGULAR;
    }
    number = R(4) * (start.beta + start.eta) * start.eta;
    if (number <= R(KANTOROVICH)) {
        result->segments += 1;
        result->kantorovich = larger(result->kantorovich, number);
        if (!correct(legs, target, &start, R(1), &next, &result->newton_steps)) {
            return STUCK;
        }
        *place = next;
        return ARRIVED;
    }
    /* eta scales with the part taken; 4 (beta + x) x <= 0.88 for x = 0.22 / (beta + 0.22), as beta >= 1 */
    part = R(0.22) / ((start.beta + R(0.22)) * start.eta);
    if (!(part > R(0))) {
        return STUCK;
    }
    part = smaller(part, R(1));
    for (i = 0; i < 6; i++) {
        between[i] = here.squares[i] - R(2) * part * here.f[i];
    }
    eta = part * start.eta + start.slack;
    number = R(4) * (start.beta + eta) * eta;
    if (!(number <= PROVED)) {
        return STUCK;
    }
    result->segments += 1;
    result->kantorovich = larger(result->kantorovich, number);
    if (!correct(legs, between, &start, part, &next, &result->newton_steps)) {
        return STUCK;
    }
    *place = next;
    *taken = part;
    return ADVANCED;
}

/* Residual, condition, distance and error at the end. The error is that of Newton's method: at a pose with 4 (beta + eta) eta <= 1 the root
 * is within 2 eta in the norm max(|h|, |w|), h a shift over the unit, w half the turn to first order. 1 where the errors have these bounds. */
static int measure(const equipod_legs *legs, const real_t target[6], const real_t target_error[6], const place_t *from, const place_t *place,
                   start_t *start, equipod_result *result)
{
    local_t here;
    blur_t blur;
    real_t largest = R(0), p[3];
    int i, k, bounded = 0;
    local_at(legs, place, target, &here);
    for (i = 0; i < 6; i++) {
        largest = is_nan(here.f[i]) ? here.f[i] : larger(largest, R(2) * FABS(here.f[i]));
    }
    result->residual = largest * legs->residual_scale;
    blur_of(legs, place, &here, target_error, &blur);
    if (start_of(&here, &blur, start)) {
        result->frobenius_ratio = start->frobenius_ratio;
        if (R(4) * (start->beta + start->eta) * start->eta <= PROVED) {
            const real_t angle = (R(4) * start->eta + blur.turn) * UP;
            const real_t sizes = norm(legs->origin) + norm(legs->centre) + legs->unit * norm(place->position);
            result->angle_error = angle;
            result->position_error = (R(2) * start->eta * legs->unit + angle * norm(legs->centre) + R(12) * U * sizes) * UP;
            bounded = is_finite(result->position_error);
        }
    } else {
        result->frobenius_ratio = R(0);
    }
    for (k = 0; k < 3; k++) {
        p[k] = place->position[k] - from->position[k];
    }
    result->distance = norm(p) * legs->unit;
    return bounded;
}

equipod_status equipod_track(const equipod_legs *legs, const real_t s[6], const real_t *radius, const equipod_pose *start, real_t singular,
                             unsigned segments, equipod_result *result)
{
    place_t from, place;
    start_t at_end;
    real_t target[6], target_error[6], left = R(1);
    int end = 0, is_singular;
    target_of(legs, s, radius, target, target_error);
    place_of(legs, start, &from);
    place = from;
    result->reason = EQUIPOD_NO_REASON;
    result->segments = 0;
    result->newton_steps = 0;
    result->kantorovich = R(0);
    result->frobenius_ratio = R(0);
    result->residual = R(0);
    result->distance = R(0);
    result->fraction = R(0);
    result->position_error = R(INFINITY);
    result->angle_error = R(INFINITY);
    if (!make_rotation(&place)) {
        result->pose = *start;
        result->status = EQUIPOD_LOST;
        result->reason = EQUIPOD_START_IS_NO_POSE;
        return result->status;
    }
    while (!end) {
        real_t part = R(0);
        if (result->segments >= segments) {
            result->reason = EQUIPOD_SEGMENTS_EXHAUSTED;
            result->fraction = R(1) - left;
            break;
        }
        switch (segment(legs, target, target_error, singular, &place, &part, result)) {
        case ARRIVED:
            result->fraction = R(1);
            end = 1;
            break;
        case ADVANCED:
            left *= R(1) - part;
            break;
        case SINGULAR:
            result->fraction = R(1) - left;
            end = 1;
            break;
        default:
            result->reason = EQUIPOD_NO_CONVERGENCE;
            result->fraction = R(1) - left;
            end = 1;
            break;
        }
    }
    (void)measure(legs, target, target_error, &from, &place, &at_end, result);
    pose_of(legs, &place, &result->pose);
    is_singular = !(result->frobenius_ratio >= singular);
    if (is_singular || (result->reason == EQUIPOD_NO_REASON && result->fraction < R(1))) {
        result->reason = EQUIPOD_NO_REASON;
        result->status = EQUIPOD_NEAR_SINGULAR;
    } else {
        result->status = result->reason == EQUIPOD_NO_REASON ? EQUIPOD_TRACKED : EQUIPOD_LOST;
    }
    if (result->status != EQUIPOD_TRACKED) {
        /* the lengths of that pose are others than those asked for */
        result->position_error = R(INFINITY);
        result->angle_error = R(INFINITY);
    }
    return result->status;
}

/* Plain Newton steps; 0 where the Jacobian is singular. */
static int step_on(const equipod_legs *legs, const real_t target[6], unsigned steps, place_t *place)
{
    unsigned n;
    for (n = 0; n < steps; n++) {
        local_t here;
        real_t step[6];
        local_at(legs, place, target, &here);
        if (!newton(&here, step)) {
            return 0;
        }
        apply_step(step, place);
    }
    return 1;
}

int equipod_newton_steps(const equipod_legs *legs, const real_t s[6], const equipod_pose *start, unsigned steps, equipod_pose *pose)
{
    place_t place;
    real_t target[6], target_error[6];
    target_of(legs, s, 0, target, target_error);
    place_of(legs, start, &place);
    if (!make_rotation(&place) || !step_on(legs, target, steps, &place)) {
        return 0;
    }
    pose_of(legs, &place, pose);
    return 1;
}

int equipod_map_squares(const equipod_map *map, const real_t s[6], real_t to[6], real_t radius[6])
{
    int i, j, first = 0;
    for (i = 0; i < 6; i++) {
        real_t sum = map->c[i], size = FABS(map->c[i]);
        for (j = 0; j < 6; j++) {
            const real_t term = map->a[i][j] * s[j];
            sum += term;
            size += FABS(term);
        }
        /* each term passes at most seven operations after the rounding of its coefficient */
        to[i] = sum;
        radius[i] = R(12) * U * size + R(LEAST);
        if (first == 0 && (!is_finite(sum) || sum < R(0))) {
            first = i + 1;
        }
    }
    return first;
}

/* Corrects the pose of a result by `steps` Newton steps on the measured joints, and by more until rounding is all that is left. 1 where
 * these joints prove the pose reached: its errors have bounds, and a ball of regular poses about it holds the start. */
static int correct_on(const equipod_legs *measured, const real_t s[6], const equipod_pose *start, real_t singular, unsigned steps,
                      equipod_result *result)
{
    place_t from, place;
    start_t at_end;
    real_t target[6], target_error[6];
    unsigned n;
    int converged = 0;
    target_of(measured, s, 0, target, target_error);
    place_of(measured, start, &from);
    place_of(measured, &result->pose, &place);
    result->position_error = R(INFINITY);
    result->angle_error = R(INFINITY);
    if (!make_rotation(&from) || !make_rotation(&place)) {
        return 0;
    }
    for (n = 0; n < EQUIPOD_CORRECTIONS && !converged; n++) {
        result->newton_steps += steps;
        if (!step_on(measured, target, steps, &place) || !measure(measured, target, target_error, &from, &place, &at_end, result)
            || !(result->frobenius_ratio >= singular)
            || !ball_holds(&place, at_end.beta + at_end.eta + at_end.slack, at_end.epsilon, &from)) {
            return 0;
        }
        converged = at_end.eta <= R(2) * at_end.slack;
        steps = 1;
    }
    pose_of(measured, &place, &result->pose);
    return converged;
}

equipod_status equipod_track_mapped(const equipod_map *map, const equipod_legs *octahedral, const equipod_legs *measured, const real_t s[6],
                                    const equipod_pose *start, real_t singular, unsigned segments, unsigned corrections,
                                    equipod_result *result)
{
    const equipod_pose from = *start;
    real_t squares[6], radius[6];
    unsigned segments_before, steps_before;
    /* squares that no pose has are below zero here: the tracker says how far it is possible to go */
    (void)equipod_map_squares(map, s, squares, radius);
    (void)equipod_track(octahedral, squares, radius, &from, singular, segments, result);
    if (corrections == 0u
        || (result->status == EQUIPOD_TRACKED && correct_on(measured, s, &from, singular, corrections, result))) {
        return result->status;
    }
    segments_before = result->segments;
    steps_before = result->newton_steps;
    (void)equipod_track(measured, s, 0, &from, singular, segments, result);
    result->segments += segments_before;
    result->newton_steps += steps_before;
    if (result->status == EQUIPOD_TRACKED && !is_finite(result->position_error)) {
        result->status = EQUIPOD_LOST;
        result->reason = EQUIPOD_NO_CONVERGENCE;
    }
    return result->status;
}

/* ---- lengths, Jacobian, limits ------------------------------------------------------------------------------------------------------*/

int equipod_prepare(const real_t base[6][3], const real_t platform[6][3], equipod_legs *legs)
{
    real_t sum = R(0), size = R(0);
    int i, k, finite = 1;
    for (k = 0; k < 3; k++) {
        real_t a = R(0), b = R(0);
        for (i = 0; i < 6; i++) {
            legs->base[i][k] = base[i][k];
            legs->platform[i][k] = platform[i][k];
            a += base[i][k];
            b += platform[i][k];
        }
        legs->origin[k] = a / R(6);
        legs->centre[k] = b / R(6);
    }
    for (i = 0; i < 6; i++) {
        real_t a[3], b[3];
        for (k = 0; k < 3; k++) {
            a[k] = base[i][k] - legs->origin[k];
            b[k] = platform[i][k] - legs->centre[k];
        }
        sum += dot(b, b);
        size = larger(larger(size, norm(a)), norm(b));
    }
    legs->unit = R(2) * (sum > R(0) ? SQRT(sum / R(6)) : size);
    if (!(legs->unit > R(0)) || !is_finite(legs->unit) || !is_finite(size)) {
        return 0;
    }
    legs->residual_scale = (legs->unit / size) * (legs->unit / size);
    for (i = 0; i < 6; i++) {
        for (k = 0; k < 3; k++) {
            legs->reduced_base[i][k] = (base[i][k] - legs->origin[k]) / legs->unit;
            legs->reduced_platform[i][k] = (platform[i][k] - legs->centre[k]) / legs->unit;
            finite = finite && is_finite(legs->reduced_base[i][k]) && is_finite(legs->reduced_platform[i][k]);
        }
        legs->loose_base[i] = R(0);
        legs->loose_platform[i] = R(0);
    }
    return finite;
}

void equipod_pose_from_angles(const real_t position[3], const real_t roll_pitch_yaw[3], equipod_pose *pose)
{
    const real_t sr = SIN(roll_pitch_yaw[0]), cr = COS(roll_pitch_yaw[0]);
    const real_t sp = SIN(roll_pitch_yaw[1]), cp = COS(roll_pitch_yaw[1]);
    const real_t sy = SIN(roll_pitch_yaw[2]), cy = COS(roll_pitch_yaw[2]);
    int k;
    pose->rotation[0][0] = cy * cp;
    pose->rotation[0][1] = cy * sp * sr - sy * cr;
    pose->rotation[0][2] = cy * sp * cr + sy * sr;
    pose->rotation[1][0] = sy * cp;
    pose->rotation[1][1] = sy * sp * sr + cy * cr;
    pose->rotation[1][2] = sy * sp * cr - cy * sr;
    pose->rotation[2][0] = -sp;
    pose->rotation[2][1] = cp * sr;
    pose->rotation[2][2] = cp * cr;
    for (k = 0; k < 3; k++) {
        pose->position[k] = position[k];
    }
}

void equipod_angles(const equipod_pose *pose, real_t roll_pitch_yaw[3])
{
    /* at a pitch of a right angle only a combination of roll and yaw is determined: the roll belongs to the yaw */
    const real_t yaw = ATAN2(pose->rotation[1][0] + R(0), pose->rotation[0][0] + R(0));
    const real_t s = SIN(yaw), c = COS(yaw);
    const real_t across = SQRT(pose->rotation[0][0] * pose->rotation[0][0] + pose->rotation[1][0] * pose->rotation[1][0]);
    roll_pitch_yaw[0] = ATAN2(s * pose->rotation[0][2] - c * pose->rotation[1][2], c * pose->rotation[1][1] - s * pose->rotation[0][1]);
    roll_pitch_yaw[1] = ATAN2(-pose->rotation[2][0], across);
    roll_pitch_yaw[2] = yaw;
}

/* R b_i and R b_i + p - a_i. */
static void leg_line(const equipod_legs *legs, const equipod_pose *pose, int i, real_t arm[3], real_t line[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        arm[k] = dot(pose->rotation[k], legs->platform[i]);
        line[k] = arm[k] + pose->position[k] - legs->base[i][k];
    }
}

void equipod_squared_lengths(const equipod_legs *legs, const equipod_pose *pose, real_t s[6])
{
    int i;
    for (i = 0; i < 6; i++) {
        real_t arm[3], line[3];
        leg_line(legs, pose, i, arm, line);
        s[i] = dot(line, line);
    }
}

void equipod_lengths(const equipod_legs *legs, const equipod_pose *pose, real_t l[6])
{
    int i;
    equipod_squared_lengths(legs, pose, l);
    for (i = 0; i < 6; i++) {
        l[i] = SQRT(l[i]);
    }
}

int equipod_jacobian(const equipod_legs *legs, const equipod_pose *pose, real_t j[6][6])
{
    int i, k, regular = 1;
    for (i = 0; i < 6; i++) {
        real_t arm[3], line[3], length;
        leg_line(legs, pose, i, arm, line);
        length = norm(line);
        regular = regular && length > R(0);
        for (k = 0; k < 3; k++) {
            j[i][k] = line[k] / length;
        }
        cross(arm, j[i], j[i] + 3);
    }
    return regular;
}

int equipod_pose_covariance(const equipod_legs *legs, const equipod_pose *pose, const real_t joints[42][42], real_t covariance[6][6])
{
    /* With u_i the direction of leg i its length is shown too long by (R^T u_i) . db_i - u_i . da_i + do_i. */
    real_t by[6][7], along[6][42], of_lengths[6][6];
    matrix6 j, inverse;
    int i, k, l, n;
    if (!equipod_jacobian(legs, pose, j)) {
        return 0;
    }
    for (i = 0; i < 6; i++) {
        for (k = 0; k < 3; k++) {
            by[i][k] = -j[i][k];
            by[i][3 + k] = pose->rotation[0][k] * j[i][0] + pose->rotation[1][k] * j[i][1] + pose->rotation[2][k] * j[i][2];
        }
        by[i][6] = R(1);
        for (n = 0; n < 42; n++) {
            along[i][n] = R(0);
            for (k = 0; k < 7; k++) {
                along[i][n] += by[i][k] * joints[7 * i + k][n];
            }
        }
    }
    for (i = 0; i < 6; i++) {
        for (l = 0; l < 6; l++) {
            of_lengths[i][l] = R(0);
            for (k = 0; k < 7; k++) {
                of_lengths[i][l] += along[i][7 * l + k] * by[l][k];
            }
            inverse[i][l] = i == l ? R(1) : R(0);
        }
    }
    if (!invert(j, inverse)) {
        return 0;
    }
    for (i = 0; i < 6; i++) {
        real_t half[6];
        for (l = 0; l < 6; l++) {
            half[l] = R(0);
            for (k = 0; k < 6; k++) {
                half[l] += inverse[i][k] * of_lengths[k][l];
            }
        }
        for (l = 0; l < 6; l++) {
            covariance[i][l] = R(0);
            for (k = 0; k < 6; k++) {
                covariance[i][l] += half[k] * inverse[l][k];
            }
        }
    }
    return 1;
}

static real_t angle_degrees(const real_t u[3], const real_t v[3])
{
    real_t c[3];
    cross(u, v, c);
    return ATAN2(norm(c), dot(u, v)) * R(DEGREES);
}

void equipod_limit_margins(const equipod_limits *limits, const equipod_legs *legs, const equipod_pose *pose, equipod_margins *margins)
{
    real_t nearest_length = R(INFINITY), nearest_cone_angle = R(INFINITY);
    int i, k;
    margins->met = 1;
    margins->length_binds = EQUIPOD_TOO_SHORT;
    margins->cone_angle_binds = EQUIPOD_BASE_CONE_ANGLE;
    margins->length_leg = -1;
    margins->cone_angle_leg = -1;
    for (i = 0; i < 6; i++) {
        real_t arm[3], line[3], back[3], length;
        leg_line(legs, pose, i, arm, line);
        length = norm(line);
        for (k = 0; k < 3; k++) {
            back[k] = pose->rotation[0][k] * line[0] + pose->rotation[1][k] * line[1] + pose->rotation[2][k] * line[2];
        }
        margins->too_short[i] = limits->has_length ? length - limits->least : R(INFINITY);
        margins->too_long[i] = limits->has_length ? limits->greatest - length : R(INFINITY);
        margins->base_cone_angle_degrees[i] =
            limits->has_base_cone_angle ? limits->base_cone_angle_degrees - angle_degrees(line, limits->base_axis[i]) : R(INFINITY);
        margins->platform_cone_angle_degrees[i] =
            limits->has_platform_cone_angle ? limits->platform_cone_angle_degrees - angle_degrees(back, limits->platform_axis[i]) : R(INFINITY);
        if (margins->too_short[i] < nearest_length) {
            nearest_length = margins->too_short[i];
            margins->length_binds = EQUIPOD_TOO_SHORT;
            margins->length_leg = i;
        }
        if (margins->too_long[i] < nearest_length) {
            nearest_length = margins->too_long[i];
            margins->length_binds = EQUIPOD_TOO_LONG;
            margins->length_leg = i;
        }
        if (margins->base_cone_angle_degrees[i] < nearest_cone_angle) {
            nearest_cone_angle = margins->base_cone_angle_degrees[i];
            margins->cone_angle_binds = EQUIPOD_BASE_CONE_ANGLE;
            margins->cone_angle_leg = i;
        }
        if (margins->platform_cone_angle_degrees[i] < nearest_cone_angle) {
            nearest_cone_angle = margins->platform_cone_angle_degrees[i];
            margins->cone_angle_binds = EQUIPOD_PLATFORM_CONE_ANGLE;
            margins->cone_angle_leg = i;
        }
        /* what is not a number is not met */
        margins->met = margins->met && margins->too_short[i] >= R(0) && margins->too_long[i] >= R(0)
                       && margins->base_cone_angle_degrees[i] >= R(0) && margins->platform_cone_angle_degrees[i] >= R(0);
    }
}

/* p + t velocity, exp(t [turn]) R. */
static void pose_on_way(const equipod_pose *start, const real_t velocity[3], const real_t turn[3], real_t t, equipod_pose *pose)
{
    const real_t rate = norm(turn), angle = t * rate;
    const real_t s = SIN(angle), half = SIN(angle / R(2)), versed = R(2) * half * half;
    real_t axis[3];
    int i, j;
    for (i = 0; i < 3; i++) {
        axis[i] = rate > R(0) ? turn[i] / rate : R(0);
        pose->position[i] = start->position[i] + t * velocity[i];
    }
    for (j = 0; j < 3; j++) {
        real_t column[3], once[3], twice[3];
        for (i = 0; i < 3; i++) {
            column[i] = start->rotation[i][j];
        }
        cross(axis, column, once);
        cross(axis, once, twice);
        for (i = 0; i < 3; i++) {
            pose->rotation[i][j] = column[i] + s * once[i] + versed * twice[i];
        }
    }
}

/* First root of f + rate t - k t^2 / 2; a negative f is one of rounding. */
static real_t first_root(real_t f, real_t rate, real_t k)
{
    real_t root;
    f = larger(f, R(0));
    root = SQRT(rate * rate + R(2) * k * f);
    if (rate < R(0)) {
        return R(2) * f / (root - rate);
    }
    return k > R(0) ? (rate + root) / k : R(INFINITY);
}

/* A leg keeps three quarters of its length in a step. */
#define KEPT 0.75

/* Motion of the line of a leg in the frame of one of its ends: velocity, and bounds of speed and acceleration over a step up to `cap`. */
typedef struct {
    real_t velocity[3], speed, acceleration, cap;
} line_motion;

static real_t cap_of(real_t length, real_t speed)
{
    return speed > R(0) ? (R(1) - R(KEPT)) * length / speed : R(INFINITY);
}

/* The step that the angle between the leg and an axis allows, both in the base frame. */
static real_t cone_angle_step(const line_motion *motion, const real_t u[3], real_t length, const real_t axis[3], real_t limit_degrees)
{
    const real_t kept = R(KEPT) * length, along = dot(u, motion->velocity), speed = motion->speed / kept;
    real_t across[3];
    int k;
    if (limit_degrees >= R(180)) {
        return R(INFINITY);
    }
    for (k = 0; k < 3; k++) {
        across[k] = motion->velocity[k] - along * u[k];
    }
    return smaller(first_root(dot(u, axis) - COS(limit_degrees / R(DEGREES)), dot(across, axis) / length,
                              motion->acceleration / kept + R(3) * speed * speed),
                   motion->cap);
}

/* A step over which no limit of lengths and cone angles can be reached; docs/theory/reach.md has the bounds. */
static real_t free_step(const equipod_limits *limits, const equipod_legs *legs, const equipod_pose *pose, const real_t velocity[3], const real_t turn[3])
{
    const real_t v = norm(velocity), w = norm(turn);
    real_t least = R(INFINITY);
    int i, k;
    for (i = 0; i < 6; i++) {
        real_t arm[3], line[3], u[3], q[3], turned[3], axis[3], length, size, first, grown;
        line_motion base, platform;
        leg_line(legs, pose, i, arm, line);
        length = norm(line);
        cross(turn, arm, turned);
        size = norm(turned);
        for (k = 0; k < 3; k++) {
            u[k] = line[k] / length;
            q[k] = line[k] - arm[k];
            base.velocity[k] = velocity[k] + turned[k];
        }
        base.speed = v + size;
        base.acceleration = w * size;
        base.cap = cap_of(length, base.speed);
        if (limits->has_length) {
            const real_t rate = dot(u, base.velocity), bend = base.acceleration + base.speed * base.speed / (R(KEPT) * length);
            least = smaller(first_root(length - limits->least, rate, base.acceleration), least);
            least = smaller(smaller(first_root(limits->greatest - length, -rate, bend), base.cap), least);
        }
        if (limits->has_base_cone_angle) {
            least = smaller(cone_angle_step(&base, u, length, limits->base_axis[i], limits->base_cone_angle_degrees), least);
        }
        if (limits->has_platform_cone_angle) {
            cross(turn, q, turned);
            size = norm(turned);
            first = cap_of(length, v + size);
            grown = v * w > R(0) && is_finite(first) ? v * w * first : R(0);
            for (k = 0; k < 3; k++) {
                platform.velocity[k] = velocity[k] - turned[k];
                axis[k] = dot(pose->rotation[k], limits->platform_axis[i]);
            }
            platform.speed = v + size + grown;
            platform.acceleration = w * (size + grown) + R(2) * v * w;
            platform.cap = smaller(cap_of(length, platform.speed), first);
            least = smaller(cone_angle_step(&platform, u, length, axis, limits->platform_cone_angle_degrees), least);
        }
    }
    return least;
}

/* The limit that is violated most, lengths as shares of the unit, angles of a right angle. */
static void name_binding(const equipod_legs *legs, const equipod_margins *margins, equipod_travel *travel)
{
    real_t worst = R(0);
    int i, k;
    for (i = 0; i < 6; i++) {
        const real_t shares[4] = {margins->too_short[i] / legs->unit, margins->too_long[i] / legs->unit,
                                  margins->base_cone_angle_degrees[i] / R(90), margins->platform_cone_angle_degrees[i] / R(90)};
        for (k = 0; k < 4; k++) {
            if (shares[k] < worst) {
                worst = shares[k];
                travel->limit = (equipod_limit)k;
                travel->leg = i;
            }
        }
    }
}

int equipod_free_path(const equipod_limits *limits, const equipod_legs *legs, const equipod_pose *start, const real_t velocity[3], const real_t turn[3],
                     real_t most, unsigned poses, equipod_travel *travel)
{
    const equipod_pose from = *start;
    equipod_margins margins;
    equipod_pose pose;
    real_t fastest = R(0), shortest, longest, nudge, met = R(0), violated = R(0);
    int i, outside = 0;
    travel->amount = R(0);
    travel->pose = from;
    travel->binds = 0;
    travel->limit = EQUIPOD_TOO_SHORT;
    travel->leg = -1;
    travel->poses = 1;
    equipod_limit_margins(limits, legs, &from, &margins);
    if (!margins.met) {
        travel->binds = 1;
        name_binding(legs, &margins, travel);
        return 0;
    }
    for (i = 0; i < 6; i++) {
        real_t arm[3], line[3], turned[3];
        leg_line(legs, &from, i, arm, line);
        cross(turn, arm, turned);
        fastest = larger(fastest, norm(velocity) + norm(turned));
    }
    fastest = larger(fastest, R(LEAST));
    longest = R(0.02) * legs->unit / fastest;
#ifdef EQUIPOD_FLOAT
    shortest = R(1e-3) * legs->unit / fastest;
#else
    shortest = R(1e-5) * legs->unit / fastest;
#endif
    nudge = shortest;
    while (!outside && met < most && travel->poses < poses) {
        const real_t safe = free_step(limits, legs, &travel->pose, velocity, turn);
        const real_t step = larger(smaller(safe, R(50) * longest), nudge);
        const real_t next = step < most - met ? met + step : most;
        nudge = safe < nudge ? smaller(R(2) * nudge, longest) : shortest;
        pose_on_way(&from, velocity, turn, next, &pose);
        equipod_limit_margins(limits, legs, &pose, &margins);
        travel->poses += 1;
        if (margins.met) {
            met = next;
            travel->pose = pose;
        } else {
            outside = 1;
            violated = next;
        }
    }
    while (outside && travel->poses < poses && violated - met > R(8) * R(EPSILON) * (violated + shortest)) {
        const real_t middle = R(0.5) * (met + violated);
        pose_on_way(&from, velocity, turn, middle, &pose);
        equipod_limit_margins(limits, legs, &pose, &margins);
        travel->poses += 1;
        if (margins.met) {
            met = middle;
            travel->pose = pose;
        } else {
            violated = middle;
        }
    }
    if (outside) {
        pose_on_way(&from, velocity, turn, violated, &pose);
        equipod_limit_margins(limits, legs, &pose, &margins);
        travel->binds = 1;
        name_binding(legs, &margins, travel);
    }
    travel->amount = met;
    return 1;
}

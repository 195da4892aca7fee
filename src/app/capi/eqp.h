/* C interface of equipod: leg lengths, poses, limits of Gough-Stewart platforms. Made by cbindgen from src/app/capi; docs/c-interface.md explains it. */

#ifndef EQP_H
#define EQP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/*
 Size of the message of an error, bytes, including the zero at its end.
 */
#define EQP_MESSAGE 1024

/*
 The outcome of a call.
 */
typedef enum eqp_status {
    /*
     Success.
     */
    EQP_STATUS_OK = 0,
    /*
     A required pointer is null, or a number of items is too large.
     */
    EQP_STATUS_BAD_POINTER = 1,
    /*
     A text is not UTF-8.
     */
    EQP_STATUS_BAD_TEXT = 2,
    /*
     The text of a design is refused; the message lists all violations.
     */
    EQP_STATUS_BAD_DESIGN = 3,
    /*
     A file cannot be read.
     */
    EQP_STATUS_FILE = 4,
    /*
     Joints and legs that make no platform.
     */
    EQP_STATUS_BAD_JOINTS = 5,
    /*
     Values that are no leg lengths, or a characteristic length that is not positive and finite.
     */
    EQP_STATUS_BAD_LENGTHS = 6,
    /*
     Numbers that make no pose.
     */
    EQP_STATUS_BAD_POSE = 7,
    /*
     A pose so far away that lengths overflow.
     */
    EQP_STATUS_OVERFLOW = 8,
    /*
     No pose that meets the requirements was found.
     */
    EQP_STATUS_NO_ALLOWED_POSE = 9,
    /*
     An index beyond the number of items.
     */
    EQP_STATUS_BAD_INDEX = 10,
    /*
     A failed computation, or a leg of length zero, which has no direction.
     */
    EQP_STATUS_COMPUTATION = 11,
    /*
     An error of the library.
     */
    EQP_STATUS_INTERNAL = 12,
    /*
     The legs of a design are rods on cranks: functions for them are in the C of `equipod export DESIGN --to c`.
     */
    EQP_STATUS_CRANKS = 13,
} eqp_status;

/*
 Whether a list holds all poses.
 */
typedef enum eqp_completeness {
    /*
     Nothing is known.
     */
    EQP_COMPLETENESS_UNPROVED = 0,
    /*
     The list has as many poses as counted modulo random primes; the library bounds the probability of a wrong count.
     */
    EQP_COMPLETENESS_MODULAR = 1,
    /*
     The list has as many poses as a theorem allows.
     */
    EQP_COMPLETENESS_PROVED = 2,
    /*
     The list has all poses up to a distance, so all real ones, by a theorem; all others are proved to be farther
     away.
     */
    EQP_COMPLETENESS_PROVED_BOUNDED = 3,
} eqp_completeness;

/*
 Whether a pose is real.
 */
typedef enum eqp_reality {
    /*
     The pose is not real.
     */
    EQP_REALITY_COMPLEX = 0,
    /*
     The pose is real.
     */
    EQP_REALITY_REAL = 1,
    /*
     Undecided.
     */
    EQP_REALITY_UNDECIDED = 2,
} eqp_reality;

/*
 The outcome of a step.
 */
typedef enum eqp_track_status {
    /*
     The pose continues the last one through regular poses, so the assembly mode is the same.
     */
    EQP_TRACK_STATUS_TRACKED = 0,
    /*
     A singular pose lies on the path or at its end.
     */
    EQP_TRACK_STATUS_NEAR_SINGULAR = 1,
    /*
     The pose is lost. The lengths are too far from the last ones, or rounding keeps Newton's method from the
     accuracy that the test needs.
     */
    EQP_TRACK_STATUS_LOST = 2,
} eqp_track_status;

/*
 An immutable design, which threads may share.
 */
typedef struct eqp_design eqp_design;

/*
 All finite poses for one row of lengths, real ones first.
 */
typedef struct eqp_solutions eqp_solutions;

/*
 A design prepared for many lengths. It is immutable, and threads may share it.
 */
typedef struct eqp_solver eqp_solver;

/*
 Tracks the pose of a machine. It belongs to one thread at a time; a step takes a few microseconds and allocates
 nothing.
 */
typedef struct eqp_tracker eqp_tracker;

/*
 An error in words, owned by the caller. Pass a null pointer in its place to get no words.
 */
typedef struct eqp_error {
    /*
     The outcome of the call.
     */
    enum eqp_status status;
    /*
     The message, UTF-8 with a zero at its end; cut if it is too long, empty on success.
     */
    char message[EQP_MESSAGE];
} eqp_error;

/*
 A pose: it moves a platform point `x` to `R x + p` in the base frame.
 */
typedef struct eqp_pose {
    /*
     The rotation matrix `R`, row by row.
     */
    double rotation[3][3];
    /*
     The position `p`, design units.
     */
    double position[3];
} eqp_pose;

/*
 The free travel of one number of a pose while the others stay fixed. The number is x, y, z in design units, or roll,
 pitch, yaw in degrees.
 */
typedef struct eqp_free_range {
    /*
     The travel towards smaller values, not negative.
     */
    double back;
    /*
     The travel towards greater values, not negative.
     */
    double forth;
    /*
     Whether a requirement ends the travel `back`; otherwise none does within half a turn, or ten sizes of the
     design.
     */
    bool back_binds;
    /*
     Whether a requirement ends the travel `forth`.
     */
    bool forth_binds;
} eqp_free_range;

/*
 The allowed pose found near a pose that is not allowed.
 */
typedef struct eqp_nearest {
    /*
     The pose.
     */
    struct eqp_pose pose;
    /*
     The distance `sqrt(|p - p'|^2 + (L angle)^2)` from the given pose, with the characteristic length `L` of the
     design; 0 if the given pose is allowed.
     */
    double distance;
    /*
     Whether it is locally nearest, as far as margins are smooth.
     */
    bool stationary;
    /*
     Whether the straight path from home to the pose violates nothing.
     */
    bool straight_from_home;
} eqp_nearest;

/*
 A pose with its evidence.
 */
typedef struct eqp_solution {
    /*
     Real part of `R`, row by row.
     */
    double rotation[3][3];
    /*
     Real part of `p`, design units.
     */
    double position[3];
    /*
     Imaginary part of `R`; zero for a real pose.
     */
    double rotation_imaginary[3][3];
    /*
     Imaginary part of `p`, design units.
     */
    double position_imaginary[3];
    /*
     Whether the pose is real.
     */
    enum eqp_reality reality;
    /*
     Whether a proof in interval arithmetic shows that such a pose exists near these numbers.
     */
    bool certified;
    /*
     Greatest error of an entry of `R` against the proved pose; infinite without a certificate.
     */
    double rotation_error;
    /*
     Greatest error of an entry of `p` against the proved pose, design units; infinite without a certificate.
     */
    double position_error;
    /*
     The multiplicity of the pose.
     */
    uint32_t multiplicity;
    /*
     Largest error of the leg equations divided by the squared size of the design.
     */
    double residual;
} eqp_solution;

/*
 A step with its evidence.
 */
typedef struct eqp_track {
    /*
     The outcome of the step.
     */
    enum eqp_track_status status;
    /*
     The pose for the lengths if it was tracked, otherwise the last pose on the path to them.
     */
    struct eqp_pose pose;
    /*
     The fraction of the straight line of squared lengths that was covered, from 0 to 1.
     */
    double fraction;
    /*
     Largest error of the leg equations at the pose divided by the squared size of the design.
     */
    double residual;
    /*
     The ratio `6 / (|J| |J^-1|)` at the pose: 1 at best, 0 at a singular pose.
     */
    double frobenius_ratio;
    /*
     Number of Newton steps.
     */
    uint32_t newton_steps;
} eqp_track;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 The version of the library, `major.minor.patch`, a static text.
 */
const char *eqp_version(void);

/*
 Reads the text of a design file, TOML, of `length` bytes.

 # Safety
 `text` points to `length` bytes, and `design` to a place for a pointer. The argument `error` is null or points to a
 place for an error.
 */
enum eqp_status eqp_design_from_toml(const char *text,
                                     size_t length,
                                     struct eqp_design **design,
                                     struct eqp_error *error);

/*
 Reads the text of a design file, JSON, of `length` bytes.

 # Safety
 As `eqp_design_from_toml`.
 */
enum eqp_status eqp_design_from_json(const char *text,
                                     size_t length,
                                     struct eqp_design **design,
                                     struct eqp_error *error);

/*
 Reads a design file; `path` ends with a zero and is UTF-8.

 # Safety
 `path` points to a text that ends with a zero, and `design` to a place for a pointer. The argument `error` is null
 or points to a place for an error.
 */
enum eqp_status eqp_design_load(const char *path, struct eqp_design **design, struct eqp_error *error);

/*
 Makes a design from the ends of its six legs: base joints in the base frame, platform joints in the platform frame,
 in leg order. Its home is computed, and it has no limits.

 # Safety
 `base` and `platform` point to six points of three numbers, and `design` to a place for a pointer. The argument
 `error` is null or points to a place for an error.
 */
enum eqp_status eqp_design_from_joints(const double *base,
                                       const double *platform,
                                       struct eqp_design **design,
                                       struct eqp_error *error);

/*
 The same design with another convention for poses as numbers: `text` holds the keys of `[frames]` in a design file,
 TOML, of `length` bytes, such as `rotation_order = "pi"`. Keys that are absent are as in this library.

 # Safety
 `design` is a design, `text` points to `length` bytes, and `with` to a place for a pointer. The argument `error` is
 null or points to a place for an error.
 */
enum eqp_status eqp_design_with_frames(const struct eqp_design *design,
                                       const char *text,
                                       size_t length,
                                       struct eqp_design **with,
                                       struct eqp_error *error);

/*
 Frees a design; null is ignored. Objects made from it stay valid.

 # Safety
 `design` is null or a design that was not freed.
 */
void eqp_design_free(struct eqp_design *design);

/*
 The name of a design, valid as long as the design; null for null.

 # Safety
 `design` is null or a design.
 */
const char *eqp_design_name(const struct eqp_design *design);

/*
 The unit of lengths of a design, valid as long as the design; null for null.

 # Safety
 `design` is null or a design.
 */
const char *eqp_design_units(const struct eqp_design *design);

/*
 The convention of poses as numbers in sentences, valid as long as the design; null for null.

 # Safety
 `design` is null or a design.
 */
const char *eqp_design_frames(const struct eqp_design *design);

/*
 The home pose of a design, or the default pose above the base.

 # Safety
 `design` is a design, `pose` points to a place for a pose, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_design_home(const struct eqp_design *design, struct eqp_pose *pose, struct eqp_error *error);

/*
 Inverse kinematics: six lengths for each of `count` poses.

 # Safety
 `design` is a design, `poses` points to `count` poses, and `lengths` to places for `count` rows of six numbers. The
 argument `error` is null or points to a place for an error.
 */
enum eqp_status eqp_ik(const struct eqp_design *design,
                       const struct eqp_pose *poses,
                       size_t count,
                       double *lengths,
                       struct eqp_error *error);

/*
 The Jacobian at a pose, base frame, rows `[u_i, ((R b_i) x u_i) / L]`. It gives the speed of leg `i` from the
 velocity of the platform origin and the angular velocity times `L`. `EQP_STATUS_BAD_LENGTHS` if the characteristic
 length `L` is not positive and finite, `EQP_STATUS_COMPUTATION` for a leg of length zero.

 # Safety
 `design` is a design, `pose` points to a pose, and `rows` to places for six rows of six numbers. The argument
 `error` is null or points to a place for an error.
 */
enum eqp_status eqp_jacobian(const struct eqp_design *design,
                             const struct eqp_pose *pose,
                             double characteristic_length,
                             double *rows,
                             struct eqp_error *error);

/*
 The meaning of a code, a static text, also for an unknown code.
 */
const char *eqp_status_text(int32_t status);

/*
 Whether a pose meets every requirement of the design, and `det J` has the sign that it has at home.

 # Safety
 `design` is a design, `pose` points to a pose, and `allowed` to a place for the answer. The argument `error` is null
 or points to a place for an error.
 */
enum eqp_status eqp_allowed(const struct eqp_design *design,
                            const struct eqp_pose *pose,
                            bool *allowed,
                            struct eqp_error *error);

/*
 The free travel of x, y, z, roll, pitch and yaw from a pose, each alone; `EQP_STATUS_NO_ALLOWED_POSE` if the pose
 itself is not allowed.

 # Safety
 `design` is a design, `pose` points to a pose, and `ranges` to places for six ranges. The argument `error` is null
 or points to a place for an error.
 */
enum eqp_status eqp_free_ranges(const struct eqp_design *design,
                                const struct eqp_pose *pose,
                                struct eqp_free_range *ranges,
                                struct eqp_error *error);

/*
 A pose locally nearest to `asked` among the poses that meet every requirement; `asked` itself if it does.

 # Safety
 `design` is a design, `asked` points to a pose, and `nearest` to a place for the answer. The argument `error` is
 null or points to a place for an error.
 */
enum eqp_status eqp_nearest_allowed(const struct eqp_design *design,
                                    const struct eqp_pose *asked,
                                    uint64_t seed,
                                    struct eqp_nearest *nearest,
                                    struct eqp_error *error);

/*
 Makes the pose with this position, design units, and this roll, pitch and yaw, degrees:
 `R = Rz(yaw) Ry(pitch) Rx(roll)`.

 # Safety
 `position` and `rpy_deg` point to three numbers each, and `pose` to a place for a pose. The argument `error` is null
 or points to a place for an error.
 */
enum eqp_status eqp_pose_from_rpy(const double *position,
                                  const double *rpy_deg,
                                  struct eqp_pose *pose,
                                  struct eqp_error *error);

/*
 Roll, pitch and yaw of a pose, degrees.

 # Safety
 `pose` points to a pose, `rpy_deg` to places for three numbers, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_pose_rpy(const struct eqp_pose *pose, double *rpy_deg, struct eqp_error *error);

/*
 Makes the pose of `count` numbers in the convention of a design (`eqp_design_frames`): six are position and angles,
 seven are position and a unit quaternion.

 # Safety
 `design` is a design, `numbers` points to `count` numbers, and `pose` to a place for a pose. The argument `error` is
 null or points to a place for an error.
 */
enum eqp_status eqp_pose_from_numbers(const struct eqp_design *design,
                                      const double *numbers,
                                      size_t count,
                                      struct eqp_pose *pose,
                                      struct eqp_error *error);

/*
 Position and angles of a pose in the convention of a design, six numbers, and its quaternion, four numbers;
 `quaternion` may be null.

 # Safety
 `design` is a design, `pose` points to a pose, `numbers` to places for six numbers, and `quaternion` is null or
 points to places for four. The argument `error` is null or points to a place for an error.
 */
enum eqp_status eqp_pose_numbers(const struct eqp_design *design,
                                 const struct eqp_pose *pose,
                                 double *numbers,
                                 double *quaternion,
                                 struct eqp_error *error);

/*
 Prepares a design; the solver does not need the design afterwards. The same seed gives the same answers.

 # Safety
 `design` is a design, `solver` points to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_solver_new(const struct eqp_design *design,
                               uint64_t seed,
                               struct eqp_solver **solver,
                               struct eqp_error *error);

/*
 Frees a solver; null is ignored.

 # Safety
 `solver` is null or a solver that was not freed.
 */
void eqp_solver_free(struct eqp_solver *solver);

/*
 All finite poses, real and complex, for six lengths.

 # Safety
 `solver` is a solver, `lengths` points to six numbers, and `solutions` to a place for a pointer. The argument
 `error` is null or points to a place for an error.
 */
enum eqp_status eqp_solve(const struct eqp_solver *solver,
                          const double *lengths,
                          struct eqp_solutions **solutions,
                          struct eqp_error *error);

/*
 Finds all finite poses for each of `count` rows of lengths, with up to `threads` threads; 0 means one for each
 processor. A row that fails has a null pointer in `solutions`, and its code in `statuses`, which may be null. It
 does not affect other rows. Returns the first code that is not `EQP_STATUS_OK`, with its message.

 # Safety
 `solver` is a solver, `lengths` points to `count` rows of six numbers, and `solutions` to places for `count`
 pointers. The argument `statuses` is null or points to places for `count` codes. The argument `error` is null or
 points to a place for an error.
 */
enum eqp_status eqp_solve_all(const struct eqp_solver *solver,
                              const double *lengths,
                              size_t count,
                              size_t threads,
                              struct eqp_solutions **solutions,
                              enum eqp_status *statuses,
                              struct eqp_error *error);

/*
 Frees a list of poses; null is ignored.

 # Safety
 `solutions` is null or a list that was not freed.
 */
void eqp_solutions_free(struct eqp_solutions *solutions);

/*
 Number of poses in a list; 0 for null.

 # Safety
 `solutions` is null or a list.
 */
size_t eqp_solutions_count(const struct eqp_solutions *solutions);

/*
 Whether a list holds all poses; `EQP_COMPLETENESS_UNPROVED` for null.

 # Safety
 `solutions` is null or a list.
 */
enum eqp_completeness eqp_solutions_completeness(const struct eqp_solutions *solutions);

/*
 The pose with this index in a list, from 0.

 # Safety
 `solutions` is a list, and `solution` points to a place for a pose with its evidence. The argument `error` is null
 or points to a place for an error.
 */
enum eqp_status eqp_solutions_get(const struct eqp_solutions *solutions,
                                  size_t index,
                                  struct eqp_solution *solution,
                                  struct eqp_error *error);

/*
 Makes a tracker that begins at a pose; it does not need the design afterwards.

 # Safety
 `design` is a design, `start` points to a pose, and `tracker` to a place for a pointer. The argument `error` is null
 or points to a place for an error.
 */
enum eqp_status eqp_tracker_new(const struct eqp_design *design,
                                const struct eqp_pose *start,
                                struct eqp_tracker **tracker,
                                struct eqp_error *error);

/*
 Continues the pose to six lengths. If tracking fails, the tracker stays at its old pose, and the call still returns
 `EQP_STATUS_OK`: `track` holds the outcome.

 # Safety
 `tracker` is a tracker that no other thread uses meanwhile. The argument `lengths` points to six numbers, and
 `track` to a place for the answer. The argument `error` is null or points to a place for an error.
 */
enum eqp_status eqp_tracker_step(struct eqp_tracker *tracker,
                                 const double *lengths,
                                 struct eqp_track *track,
                                 struct eqp_error *error);

/*
 The current pose of the platform.

 # Safety
 `tracker` is a tracker that no other thread steps meanwhile, and `pose` points to a place for a pose. The argument
 `error` is null or points to a place for an error.
 */
enum eqp_status eqp_tracker_pose(const struct eqp_tracker *tracker, struct eqp_pose *pose, struct eqp_error *error);

/*
 Frees a tracker; null is ignored.

 # Safety
 `tracker` is null or a tracker that was not freed.
 */
void eqp_tracker_free(struct eqp_tracker *tracker);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* EQP_H */

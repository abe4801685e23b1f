/* Aspecta: the solution of a parallel robot followed in a control loop, every step certified.
 *
 * Lengths are in the robot's unit, angles in radians. Vectors have aspecta_dof() numbers: poses in the order
 * x, y | x, y, phi | x, y, z | roll, pitch, yaw | x, y, z, roll, pitch, yaw; joint vectors one number a leg.
 * Angles are real numbers and go on past +-pi.
 *
 * aspecta_step and aspecta_inverse_step neither allocate nor print, lock, or call the system. A direct step is cut
 * into at most 64 stretches: a refused one may take some 400 times as long as a certified one, 0.4 ms in the plane
 * and 2 ms with six degrees of freedom. A handle may be used from any thread, but by one at a time; different
 * handles are independent.
 *
 * Link with libaspecta_c.so, or with libaspecta_c.a and -lm -lpthread -ldl. */

#ifndef ASPECTA_H
#define ASPECTA_H

#include <stddef.h>
#include <stdint.h>

/**
 * What a call came to.
 */
typedef enum aspecta_status {
    /**
     * Certified.
     */
    ASPECTA_OK = 0,
    /**
     * Refused: a parallel singularity is ahead. The handle stays where it was, as after every other status but
     * ASPECTA_OK.
     */
    ASPECTA_PARALLEL = 1,
    /**
     * Refused: a serial singularity of a leg is ahead, the end of its reach.
     */
    ASPECTA_SERIAL = 2,
    /**
     * Refused: the step is too long for a proof, or a jump.
     */
    ASPECTA_TOO_LONG = 3,
    /**
     * A number is not finite or beyond +-1e7, or the length of a strut is not positive.
     */
    ASPECTA_BAD_INPUT = 4,
    /**
     * A pointer is null.
     */
    ASPECTA_NULL = 5,
} aspecta_status;

/**
 * A solution of the direct problem that is followed.
 */
typedef struct aspecta_follower aspecta_follower;

/**
 * A solution of the inverse problem that is followed.
 */
typedef struct aspecta_inverse aspecta_inverse;

/**
 * What is said of a step.
 */
typedef struct aspecta_report {
    /**
     * Up to where the step is proved, a share of it; 1 if it is certified.
     */
    double proved;
    /**
     * Refused steps: where the singularity is estimated, a share of the step; NaN if there is none. Numerical.
     */
    double singular_at;
    /**
     * Refused steps: distance left from the singularity at `proved`, without unit: the smallest singular value of the
     * homogeneous A, or |B_jj| / max. NaN if certified. Numerical.
     */
    double distance;
    /**
     * Certified direct steps: bound of the error of each translation.
     */
    double length_error;
    /**
     * Certified direct steps: bound of the error of each rotation (rad).
     */
    double angle_error;
    /**
     * Bit j: B_jj < 0 for leg j + 1. The working mode.
     */
    uint32_t negative_legs;
    /**
     * Stretches that were tried.
     */
    uint32_t stretches;
    /**
     * Certified steps, 1 or 0: the configuration is proved to stay in its generalized aspect. 0 after a direct step: a
     * leg may have met a serial singularity; after an inverse step: det A may have vanished.
     */
    uint32_t same_aspect;
    /**
     * Certified steps, 1 or 0: at the end all joints are within their limits and the pose in the
     * robot's window. Numerical.
     */
    uint32_t within_limits;
    /**
     * ASPECTA_SERIAL: the leg, from 1; else 0.
     */
    uint32_t leg;
} aspecta_report;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Starts at the pose that a joint vector means, at least roughly.
 *
 * `robot` is a name of the catalogue ("five-bar") or the text of a robot file, `n` the length of both vectors.
 * Returns NULL if that cannot be; then `message` says why, in at most `size` bytes, the terminating zero included.
 * `message` may be NULL.
 *
 * # Safety
 * `robot` is null or a terminated string; `pose` and `q` are null or hold `n` numbers; `message` is null or has room for
 * `size` bytes.
 */
struct aspecta_follower *aspecta_start(const char *robot,
                                       const double *pose,
                                       const double *q,
                                       size_t n,
                                       char *message,
                                       size_t size);

/**
 * The inverse problem: starts at a pose, in the working mode given as signs of B_jj, such as "+-+".
 *
 * # Safety
 * As of aspecta_start; `mode` is null or a terminated string.
 */
struct aspecta_inverse *aspecta_inverse_start(const char *robot,
                                              const double *pose,
                                              size_t n,
                                              const char *mode,
                                              char *message,
                                              size_t size);

/**
 * Frees a handle; NULL is allowed.
 *
 * # Safety
 * `follower` is null or comes from aspecta_start, and is not used again.
 */
void aspecta_free(struct aspecta_follower *follower);

/**
 * Frees a handle of the inverse problem; NULL is allowed.
 *
 * # Safety
 * `follower` is null or comes from aspecta_inverse_start, and is not used again.
 */
void aspecta_inverse_free(struct aspecta_inverse *follower);

/**
 * Goes on to the joint vector `q`; writes the pose, if certified, and the report. `report` may be NULL.
 *
 * Returns a status.
 *
 * # Safety
 * `follower` is null or a live handle that no other thread uses; `q` and `pose` are null or hold n numbers; `report` is
 * null or valid.
 */
int aspecta_step(struct aspecta_follower *follower,
                 const double *q,
                 double *pose,
                 struct aspecta_report *report);

/**
 * Goes on to `pose`; writes the joint vector, if certified, and the report. `report` may be NULL.
 *
 * Returns a status.
 *
 * # Safety
 * As of aspecta_step.
 */
int aspecta_inverse_step(struct aspecta_inverse *follower,
                         const double *pose,
                         double *q,
                         struct aspecta_report *report);

/**
 * The pose and the joint vector of the last certified step. Either may be NULL.
 *
 * Returns a status.
 *
 * # Safety
 * `follower` is null or a live handle that no other thread changes; `pose` and `q` are null or have room for n numbers.
 */
int aspecta_last(const struct aspecta_follower *follower,
                 double *pose,
                 double *q);

/**
 * The pose and the joint vector of the last certified step of the inverse problem. Either may be NULL.
 *
 * Returns a status.
 *
 * # Safety
 * As of aspecta_last.
 */
int aspecta_inverse_last(const struct aspecta_inverse *follower, double *pose, double *q);

/**
 * Degrees of freedom; 0 for NULL.
 *
 * # Safety
 * `follower` is null or a live handle.
 */
size_t aspecta_dof(const struct aspecta_follower *follower);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ASPECTA_H */

/* Touchstone's referee as a C library: what is true of two bodies, with certificates, and whether somebody's
 * own answer about them is right.
 *
 * Right-handed, column vectors; lengths in any one unit. A body is a shape and a pose: 7 doubles, position x
 * y z and quaternion x y z w (any length but 0); NULL is the identity. A motion is 6 doubles: linear and
 * angular velocity (radians) over one step t in [0,1], world frame, rotation about the body's origin; NULL is
 * rest. Overlap includes touching. The signed gap is the distance of bodies that are apart and minus the
 * depth of an overlap; the normal points from A to B. docs/truth.md has the definitions.
 *
 * No exception leaves a function. All functions may be called from any thread; shapes are immutable and may
 * be shared between threads. Functions with an argument n answer n pairs of poses of the same two shapes;
 * pose and motion arrays hold n rows, or are NULL. */
#ifndef TOUCHSTONE_H
#define TOUCHSTONE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Semantic versions: the major number changes with the binary interface, and is that of the soname. */
#define TOUCHSTONE_VERSION_MAJOR 0
#define TOUCHSTONE_VERSION_MINOR 1
const char* touchstone_version(void); /* of the library: "0.1.0" */

typedef enum touchstone_status {
  TOUCHSTONE_OK = 0,
  TOUCHSTONE_INVALID = 2, /* an argument is not valid; outputs are unchanged */
  TOUCHSTONE_FAILED = 3   /* out of memory, or an internal error; outputs are unspecified */
} touchstone_status;
/* Why this thread's last call that did not return TOUCHSTONE_OK failed; never NULL. Valid until its next
 * call. */
const char* touchstone_last_error(void);

typedef struct touchstone_shape touchstone_shape;
/* "box 1 1 1" (half extents), "cylinder 0.5 2" (radius, half height), ... as in `touchstone answer --help`,
 * or the JSON of a shape of the scene format. The caller frees *out with touchstone_free_shape. */
touchstone_status touchstone_parse_shape(const char* text, touchstone_shape** out);
/* A shape with its place, "box 1 1 1 at 0 0 2 rot 0 0 1 30deg move 0 0 1", or the JSON of a body: pose gets 7
 * numbers, motion 6 (0 when it rests). */
touchstone_status touchstone_parse_body(const char* text, touchstone_shape** out, double* pose,
                                        double* motion);
/* The convex hull of n points, 3 doubles each. */
touchstone_status touchstone_hull(const double* points, size_t n, touchstone_shape** out);
/* A surface of m triangles, three indices each. */
touchstone_status touchstone_mesh(const double* points, size_t n, const int* triangles, size_t m,
                                  touchstone_shape** out);
void touchstone_free_shape(touchstone_shape* shape); /* NULL is ignored */
void touchstone_free_text(char* text);               /* likewise */

enum { TOUCHSTONE_DISJOINT = 0, TOUCHSTONE_OVERLAP = 1, TOUCHSTONE_UNDECIDED = 2 };

typedef struct touchstone_gap {
  double lo, hi; /* lo <= signed gap <= hi, proven; -inf: the depth in a mesh is not defined */
  double normal[3];
  double witness_a[3], witness_b[3]; /* points of A and B that realise the gap, rounded */
  int verdict;                       /* TOUCHSTONE_DISJOINT, _OVERLAP, _UNDECIDED */
  int within_margin;                 /* gap <= margin: 1 yes, 0 no, -1 undecided */
} touchstone_gap;
/* margin: a length >= 0. No certificates, so this is the fast way to ask. */
touchstone_status touchstone_gaps(const touchstone_shape* a, const double* poses_a, const touchstone_shape* b,
                                  const double* poses_b, size_t n, double margin, touchstone_gap* out);

/* The directions of least depth of an overlap: `normals` gets up to `capacity` of them, 3 doubles each,
 * *count their number, *complete 1 if these are all (0: a continuum, or not proven to be all). Cylinders,
 * cones and ellipsoids: an estimate, never complete, that may take minutes. */
touchstone_status touchstone_normals(const touchstone_shape* a, const double* pose_a,
                                     const touchstone_shape* b, const double* pose_b, double* normals,
                                     size_t capacity, size_t* count, int* complete);

enum { TOUCHSTONE_NO_IMPACT = 0, TOUCHSTONE_IMPACT = 1 }; /* or TOUCHSTONE_UNDECIDED */

typedef struct touchstone_impact {
  double t_lo, t_hi;     /* of an impact: no contact before t_lo, contact at some t <= t_hi */
  double gap_lo, gap_hi; /* the least gap over the step, as far as known */
  int verdict;
} touchstone_impact;
touchstone_status touchstone_impacts(const touchstone_shape* a, const double* poses_a,
                                     const double* motions_a, const touchstone_shape* b,
                                     const double* poses_b, const double* motions_b, size_t n,
                                     touchstone_impact* out);

/* The whole answer about one pair as one line of JSON, with certificates, as `touchstone answer --json`
 * prints it. The time of impact is included if a motion is given. The caller frees *json with
 * touchstone_free_text. */
touchstone_status touchstone_answer(const touchstone_shape* a, const double* pose_a, const double* motion_a,
                                    const touchstone_shape* b, const double* pose_b, const double* motion_b,
                                    char** json);

/* Verifies a certificate (JSON, as in that answer) in exact arithmetic. *valid: 1 if it proves its claim. */
touchstone_status touchstone_check(const touchstone_shape* a, const double* pose_a, const double* motion_a,
                                   const touchstone_shape* b, const double* pose_b, const double* motion_b,
                                   const char* certificate, int* valid);

/* What an engine says. Only what `stated` names is judged. */
enum {
  TOUCHSTONE_STATES_OVERLAP = 1,
  TOUCHSTONE_STATES_DISTANCE = 2, /* signed */
  TOUCHSTONE_STATES_NORMAL = 4,   /* from A to B */
  TOUCHSTONE_STATES_DEPTH = 8,    /* negative: minus the distance of bodies that are apart */
  TOUCHSTONE_STATES_WITNESS = 16,
  TOUCHSTONE_STATES_IMPACT = 32 /* time_of_impact; NaN: no impact in the step */
};
typedef struct touchstone_stated {
  double distance, depth, time_of_impact;
  double normal[3], witness_a[3], witness_b[3];
  int stated; /* a sum of TOUCHSTONE_STATES_... */
  int overlap;
} touchstone_stated;

enum { TOUCHSTONE_RIGHT = 0, TOUCHSTONE_WRONG = 1, TOUCHSTONE_OPEN = 2, TOUCHSTONE_NOT_JUDGED = 3 };

/* rulings[i]: TOUCHSTONE_RIGHT, _WRONG, _OPEN (the referee cannot decide), _NOT_JUDGED (a claim has no
 * definition: the depth in a mesh). An error is wrong above 64·u·L + tolerance: u is the unit roundoff of
 * double, or of float if single_precision, L the scale of the pair, tolerance a length >= 0. */
touchstone_status touchstone_judge(const touchstone_shape* a, const double* poses_a, const double* motions_a,
                                   const touchstone_shape* b, const double* poses_b, const double* motions_b,
                                   size_t n, const touchstone_stated* stated, double tolerance,
                                   int single_precision, int* rulings);
/* The same for one answer, with the reasons as JSON. The caller frees *json with touchstone_free_text. */
touchstone_status touchstone_explain(const touchstone_shape* a, const double* pose_a, const double* motion_a,
                                     const touchstone_shape* b, const double* pose_b, const double* motion_b,
                                     const touchstone_stated* stated, double tolerance, int single_precision,
                                     char** json);

#ifdef __cplusplus
}
#endif
#endif

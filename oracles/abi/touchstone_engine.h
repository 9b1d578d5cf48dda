/* touchstone_engine.h — the interface of an engine plug-in. Plain C, ABI version 2.
 *
 * A plug-in is a shared object that exports one function, `touchstone_plugin_v1`. It returns a table that lists one or
 * more engines; `./libmine.so` on a command line names its only one, `./libmine.so:NAME` one of several. The host process loads the plug-in, creates one engine, loads scenes and asks questions. The plug-in
 * may crash, hang, print or throw: the host is a separate process, and all of that is recorded as an observation.
 * The process that loads the plug-in is forked before `create`, and again after each crash: start threads in `create`
 * or later, not while the library is loaded.
 *
 * Units and frames: lengths in the scene's unit, angles in radians, world frame unless stated otherwise, column
 * vectors, right-handed. Quaternions are x, y, z, w, non-zero and NOT necessarily unit. Matrices are row-major.
 * Arrays passed by the host stay valid until the function returns; those of a scene, until it is unloaded.
 *
 * Compatibility. The table's first field is the version of the header that the plug-in was built with. A host of
 * version N loads plug-ins of all versions from 1 to N, and refuses newer ones. Within a version, what is here keeps
 * its name, place, type and meaning. Only this may change:
 *  - structures of which the host passes one at a time (ts_scene, ts_batch, ts_sink, ts_batch_sink, ts_received) may
 *    get fields at their ends;
 *  - elements of arrays (ts_shape, ts_pose, ts_aabb, ts_body, ts_step, ts_answer) keep their size; what is added about
 *    them takes the place of a `reserved` field, or is a further array at the end of ts_scene or ts_batch;
 *  - `reserved` entries of ts_plugin may become functions. A table leaves those that it does not know null (the rest of
 *    an initialiser may be left out), and the host calls none that is null;
 *  - enumerations may get values at their ends, and cards optional fields.
 * Whoever fills in a structure sets its `reserved` fields to zero; ts_answer arrives that way. Each change increments
 * the minor version, which counts on from version to version. A plug-in that needs one exports touchstone_host_v1 (at
 * the end of this header) to learn the host's. Version 2 differs from version 1 only by the ends of ts_plugin and
 * ts_answer.
 */
#ifndef TOUCHSTONE_ENGINE_H
#define TOUCHSTONE_ENGINE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TS_ABI_VERSION 2
/* 1: ts_received.other_shape, and received hulls with a different number of vertices
 * 2: "more_shapes" of a card, TS_ROUNDED_BOX
 * 3: version 2: ts_plugin.ask_many, ts_answer.ns; ts_scene.step_boxes; "shapes", "unit_roundoffs", "contact_offset",
 *    "sweep_skin", "depth_biases" and "times_include_pipe" of a card
 * 4: TS_WITHIN to TS_RAY; ts_scene.margin; ts_answer.lower, upper; TS_HAS_LOWER, TS_HAS_UPPER
 * 5: "separate_triangles" of a card; ts_answer.moment, unique_gradient; TS_HAS_MOMENT, TS_HAS_UNIQUE
 * 6: TS_SOLID_MESH
 * 7: ts_sink.named_point, ts_batch_sink.named_point
 * 8: TS_PADDED_CYLINDER to TS_PADDED_HULL
 * 9: TS_CONTACT_WITHIN */
#define TS_ABI_MINOR 9

#if defined(_WIN32)
#define TS_EXPORT __declspec(dllexport)
#else
#define TS_EXPORT __attribute__((visibility("default")))
#endif

enum ts_shape_kind {
  TS_SPHERE = 0,     /* size[0] = radius */
  TS_BOX = 1,        /* size[0..2] = half extents */
  TS_CAPSULE = 2,    /* size[0] = radius, size[1] = half height of the segment; axis z, centred */
  TS_CYLINDER = 3,   /* size[0] = radius, size[1] = half height; axis z, centred */
  TS_CONE = 4,       /* size[0] = radius, size[1] = half height; axis z, apex at +h, base at -h */
  TS_ELLIPSOID = 5,  /* size[0..2] = semi-axes */
  TS_HULL = 6,       /* vertices; triangles = its faces, counter-clockwise seen from outside; no triangles if flat */
  TS_HALF_SPACE = 7, /* size[0..2] = normal n (any length), size[3] = offset d: solid where n.x <= d */
  TS_MESH = 8,       /* vertices, triangles: a surface; a height field is one (oracles/abi/height_field.h) */
  TS_ROUNDED_BOX = 9, /* size[0..2] = half extents of a box, size[3] = radius: all points within it of the box */
  TS_SOLID_MESH = 10, /* vertices, triangles: a closed surface, counter-clockwise seen from outside, and its inside */
  /* All points within the padding of another shape; size: as of that shape, then the padding */
  TS_PADDED_CYLINDER = 11,  /* size[0] = radius, size[1] = half height, size[2] = padding */
  TS_PADDED_CONE = 12,      /* size[0] = radius, size[1] = half height, size[2] = padding */
  TS_PADDED_ELLIPSOID = 13, /* size[0..2] = semi-axes, size[3] = padding */
  TS_PADDED_HULL = 14       /* as TS_HULL; size[0] = padding */
};
/* Unless its card lists the kinds that it takes ("shapes"), an engine is sent those up to this one, and those after it
 * that the card adds ("more_shapes"). */
#define TS_LAST_COMMON_SHAPE TS_MESH
/* The last kind of this header. */
#define TS_LAST_SHAPE TS_PADDED_HULL

typedef struct ts_shape {
  int32_t kind;
  int32_t dimension; /* hulls: affine dimension of the vertices, 0..3 */
  double size[4];
  const double* vertices; /* vertex_count x 3 */
  size_t vertex_count;
  const int32_t* triangles; /* triangle_count x 3 */
  size_t triangle_count;
} ts_shape;

typedef struct ts_pose {
  double translation[3];
  double rotation[4]; /* x y z w, non-zero, any length */
} ts_pose;

typedef struct ts_aabb {
  double lower[3], upper[3]; /* closed */
} ts_aabb;

typedef struct ts_body {
  int32_t shape;
  int32_t is_static;
  int32_t has_motion;
  int32_t group; /* two bodies with the same group >= 0 are never paired: parts of one compound body */
  ts_pose pose;
  double linear[3];  /* velocity over one step t in [0,1] */
  double angular[3]; /* world frame, about the body's origin: q(t) = exp(t w) q0 */
} ts_body;

enum ts_op { TS_INSERT = 0, TS_MOVE = 1, TS_REMOVE = 2, TS_QUERY = 3 };

typedef struct ts_step {
  int32_t op;
  int32_t body;
  ts_pose pose; /* for TS_INSERT and TS_MOVE */
} ts_step;

typedef struct ts_scene {
  const ts_shape* shapes;
  size_t shape_count;
  const ts_body* bodies;
  size_t body_count;
  const ts_step* steps; /* never empty: "insert all, query" when the scene has no script */
  size_t step_count;
  const int32_t* ignored; /* ignored_count x 2, pairs i < j to filter out */
  size_t ignored_count;
  /* Since minor 3. step_count boxes: for TS_INSERT and TS_MOVE an axis-aligned box that contains the body at the step's
   * pose, rounded outward; infinite for a half-space; not a box (upper < lower, or NaN) if the body's own numbers are
   * none. NULL unless TS_CANDIDATES or TS_CANDIDATES_WITHIN will be asked about the scene. The margin is not in them. */
  const ts_aabb* step_boxes;
  double margin; /* since minor 4: a length to which TS_WITHIN, TS_BOUNDED_DISTANCE, TS_CANDIDATES_WITHIN and
                    TS_CONTACT_WITHIN refer */
} ts_scene;

enum ts_question {
  TS_OVERLAP = 0,       /* do the closed bodies a and b share a point? */
  TS_DISTANCE = 1,      /* signed distance and witness points */
  TS_CONTACT = 2,       /* overlap; if there is one, also normal, depth, manifold */
  TS_TIME_OF_IMPACT = 3, /* first t in [0,1] at which they share a point */
  /* Broad phase: run the steps, report pairs at each TS_QUERY; a, b unused. Bodies do not move, regardless of `linear`
   * and `angular`. */
  TS_CANDIDATES = 4,
  TS_SCENE_CONTACTS = 5, /* broad and narrow phase together, at the bodies' own poses; a, b unused */
  /* Broad phase of a motion: report, at k = 0, every pair that overlaps at some t in [0,1] of the bodies' motions from
   * their own poses. The steps are not run; a, b unused. */
  TS_SWEPT_CANDIDATES = 6,
  /* Since minor 4. Is the signed distance of a and b at most the scene's margin (closed)? The verdict is
   * `overlap`. A negative margin allows bodies to penetrate by less than its absolute value. */
  TS_WITHIN = 7,
  /* Since minor 4. The signed distance, which may be left out if it is more than the scene's margin: then
   * `lower`, at least the margin, says how far apart the bodies are at least. */
  TS_BOUNDED_DISTANCE = 8,
  /* Since minor 4. As TS_CANDIDATES, but for pairs whose signed distance is at most the scene's margin, which
   * is not negative. */
  TS_CANDIDATES_WITHIN = 9,
  /* Since minor 4. b is a sphere of radius 0 that moves without turning, and a is at rest: the ray from b's
   * position along b's `linear`. `toi` is the part of `linear` after which it meets a, 0 if it starts in a,
   * and `normal` the normal of a there, out of a. `overlap`, if stated, says whether it starts in a; where
   * such a ray leaves a is not asked. */
  TS_RAY = 10,
  /* Since minor 9. As TS_CONTACT, if the signed distance is at most the scene's margin (closed): `overlap` says whether
   * it is. Depths, of the contact and of its points, are negative where the bodies are apart: minus the distance. A
   * point between bodies that are apart may be anywhere between the two surfaces. */
  TS_CONTACT_WITHIN = 11
}; /* Questions may be added: leave the answer to an unknown one unchanged, i.e. TS_UNSUPPORTED. */

/* All but the first two are faults. An outcome is that of one question: the scene's other questions are asked all the
 * same. */
enum ts_outcome {
  TS_ANSWERED = 0,
  TS_UNSUPPORTED = 1,   /* the engine has no such query for these shapes: not a fault */
  TS_NOT_CONVERGED = 2, /* the engine says that its method failed here: an iteration cap, a status other than success */
  TS_INVALID_INPUT = 3, /* the engine refuses numbers that are valid */
  TS_THREW = 4          /* an exception */
};

/* Which fields of an answer are set. Fields that are not set are not judged: leave out whatever the engine's own
 * documentation disclaims. */
enum ts_has {
  TS_HAS_OVERLAP = 1,
  TS_HAS_DISTANCE = 2,
  TS_HAS_POINTS = 4,
  TS_HAS_NORMAL = 8,
  TS_HAS_DEPTH = 16,
  TS_HAS_TOI = 32, /* for TS_TIME_OF_IMPACT and TS_RAY: set = hit at `toi`, not set = "no hit" */
  /* Since minor 4, for TS_DISTANCE and TS_BOUNDED_DISTANCE. */
  TS_HAS_LOWER = 64,
  TS_HAS_UPPER = 128,
  /* Since minor 5, for TS_DISTANCE. */
  TS_HAS_MOMENT = 256, /* with TS_HAS_NORMAL: `normal` and `moment` are the gradient of the signed distance */
  TS_HAS_UNIQUE = 512
};

typedef struct ts_answer {
  int32_t outcome;
  uint32_t has;
  int32_t overlap;
  int32_t unique_gradient; /* since minor 5: 0 if the signed distance has other gradients at this pose than
                              the one stated (faces that face each other, several normals), else 1 */
  double distance;   /* signed: a negative value is minus the depth */
  double point_a[3]; /* witness on A, world */
  double point_b[3]; /* witness on B, world */
  double normal[3];  /* unit, world, from A to B: B moves along +normal to separate */
  double depth;      /* how far all of B must move along `normal` to separate from A; >= 0, but for
                        TS_CONTACT_WITHIN */
  double toi;
  double claimed_tolerance; /* absolute: margin and solver tolerance that the engine's documentation claims for this
                               answer on these shapes; 0 if it claims none beyond arithmetic. Believed only if the
                               card has a `source`; above 1e-2 L it is shown beside the verdict */
  char detail[128];         /* zero-terminated message for people */
  /* Version 2. */
  int64_t ns; /* the time of this answer in nanoseconds, if the engine knows it better than a clock around `ask`;
                 0: the host's clock decides */
  /* Since minor 4: bounds of the signed distance, each judged as the bound that it claims to be. */
  double lower, upper;
  /* Since minor 5: the derivative of the signed distance by rotations of b about the origin of its frame,
   * along world axes: (p - o) x normal for a witness point p on b and the origin o. `normal` is the
   * derivative by translations of b. */
  double moment[3];
  int64_t reserved2[2];
} ts_answer;

/* Callbacks for the variable-length parts of an answer. Pass `ctx` back unchanged. */
typedef struct ts_sink {
  void* ctx;
  /* A point of TS_CONTACT's manifold (world), anywhere between the two surfaces, and the depth there: along the line
   * through the point in the direction of the answer's normal, how far A extends beyond the point where B begins. NaN
   * means not stated: for a point with its own normal, or when the engine only knows the depth of the whole contact.
   * The depth of the contact is at least that of each point, and greater where the manifold was clipped or reduced: an
   * engine that knows its separating axis states the depth along that axis as the answer's; one that does not should
   * leave out TS_HAS_DEPTH, and its points are then judged on their own. */
  void (*point)(void* ctx, const double position[3], double depth);
  /* TS_CANDIDATES: a pair at the k-th TS_QUERY step (k from 0), in any order. TS_SWEPT_CANDIDATES: k = 0 */
  void (*pair)(void* ctx, int32_t k, int32_t a, int32_t b);
  /* TS_SCENE_CONTACTS */
  void (*contact)(void* ctx, int32_t a, int32_t b, const double normal[3], double depth);
  /* Since minor 7. In place of `point`, if the engine names the features that meet at a point (as warm starting needs):
   * while the same features meet in the next frame of a motion, the id should be the same. Any number may be
   * an id; a point without a name is passed to `point`. */
  void (*named_point)(void* ctx, const double position[3], double depth, uint64_t id);
} ts_sink;

/* The scene as the engine received it, in exact numbers: what its own types hold after conversion. Sizes follow the
 * conventions of ts_shape (half extents, half heights, n and d), whatever the engine's own are. Vertices of a mesh: all
 * of them, in order. Vertices of a hull: those that the engine holds. If their number differs from what was passed in
 * (the engine's hull builder merged some, or gave a flat hull a thickness), the engine holds a different shape: their
 * convex hull. An answer that is right for the reported scene and wrong for the original is blamed on the
 * representation, not on the algorithm. A shape or body that is not reported is assumed to be held exactly. */
typedef struct ts_received {
  void* ctx;
  void (*shape)(void* ctx, int32_t shape, const double size[4], const double* vertices, size_t vertex_count);
  void (*body)(void* ctx, int32_t body, const double matrix[9], const double translation[3]);
  /* Since minor 1. Call this instead of `shape` if the engine holds a shape of another kind, or other triangles: a box
   * for a flat hull, a hull for a cylinder. `held` is read like a shape of a scene, except that the host computes the
   * dimension and the triangles of a hull. */
  void (*other_shape)(void* ctx, int32_t shape, const ts_shape* held);
} ts_received;

/* Version 2: one question about many pairs, as arrays. Pair i is shapes[shape_a[i]] at pose_a[i] and shapes[shape_b[i]]
 * at pose_b[i]. If all pairs are of the same two shapes, shape_count is at most 2. */
typedef struct ts_batch {
  int32_t question; /* TS_OVERLAP to TS_TIME_OF_IMPACT */
  int32_t reserved;
  size_t count; /* of pairs, at least 1 */
  const ts_shape* shapes;
  size_t shape_count;
  const int32_t* shape_a; /* count each */
  const int32_t* shape_b;
  const ts_pose* pose_a; /* count each: 7 doubles without gaps */
  const ts_pose* pose_b;
  const double* motion_a; /* count x 6 each: linear, angular as in ts_body; NULL if no body moves */
  const double* motion_b;
} ts_batch;

/* Callbacks of a batch: those of ts_sink and ts_received for pair i, whose bodies are 0 (a) and 1 (b). What a pair
 * shares with others is reported for each. */
typedef struct ts_batch_sink {
  void* ctx;
  void (*point)(void* ctx, size_t i, const double position[3], double depth);
  void (*received_shape)(void* ctx, size_t i, int32_t body, const double size[4], const double* vertices,
                         size_t vertex_count);
  void (*received_other_shape)(void* ctx, size_t i, int32_t body, const ts_shape* held);
  void (*received_body)(void* ctx, size_t i, int32_t body, const double matrix[9], const double translation[3]);
  void (*named_point)(void* ctx, size_t i, const double position[3], double depth, uint64_t id); /* since minor 7 */
} ts_batch_sink;

typedef struct ts_engine ts_engine; /* yours */

typedef struct ts_plugin {
  uint32_t abi_version; /* TS_ABI_VERSION */
  uint32_t engine_count;
  /* JSON card of the i-th engine, an object with these fields and no others; those from "complete_manifolds" on are
   * optional. Lengths are in the scene's unit.
   *  - "name", "library", "version", "settings": strings; the name must not be empty.
   *  - "source": string: where the documentation makes the claims below and those of claimed_tolerance; if empty, they
   *    are not believed.
   *  - "unit_roundoff": of its arithmetic, 1.1102230246251565e-16 for doubles, 5.960464477539063e-08 for floats; at
   *    most 2^-8.
   *  - "tau_factor": the error allowed for rounding, in units of unit_roundoff times the scale L of the pair;
   *    typically 64; at most 16384, and at most 0.01 after multiplication by a unit roundoff.
   *  - "complete_manifolds": true if manifolds cover the whole contact region, which is then checked.
   *  - "more_shapes", since minor 2: the kinds after TS_LAST_COMMON_SHAPE that the engine takes besides the common
   *    ones, by the names of the scene's JSON form, e.g. ["rounded_box"].
   *  - "shapes", since minor 3, instead of "more_shapes": all kinds that the engine takes, e.g. ["sphere", "box"].
   *    Campaigns about the engine are made of these. For a scene with a kind that the engine does not take, the host
   *    answers "unsupported" and does not call `load`.
   *  - "unit_roundoffs", since minor 3: of kinds that are computed more coarsely than "unit_roundoff" says, e.g.
   *    {"mesh": 5.960464477539063e-08}. The coarser one of a pair counts.
   *  - "contact_offset", since minor 3: bodies apart by at most this are reported as in contact, with a depth of minus
   *    the distance.
   *  - "sweep_skin", since minor 3: a sweep stops when the gap is at most this.
   *  - "depth_biases", since minor 3: by what share of the least depth the normal chosen for a pair of kinds may need
   *    more, e.g. {"box box": 0.05} for a routine that prefers faces; at most 0.25.
   *  - "separate_triangles", since minor 5: true if the documentation says that a contact with a mesh is that
   *    of one of its triangles. Normals of edges inside a flat part of a mesh are then not counted as wrong.
   *  - "times_include_pipe", since minor 3: true if times include talking to another process; they are then not charted
   *    as the engine's. The host sets it for a command behind a pipe that does not state its own times. */
  const char* (*card)(uint32_t i);
  ts_engine* (*create)(uint32_t i);
  void (*destroy)(ts_engine*);
  /* Loads the scene; may call `received`. Returns a ts_outcome; if not TS_ANSWERED, detail (256 bytes) says why. */
  int32_t (*load)(ts_engine*, const ts_scene*, const ts_received* received, char* detail);
  void (*unload)(ts_engine*);
  /* Answers one question about the loaded scene. `answer` is zeroed on entry, with numbers NaN and outcome
   * TS_UNSUPPORTED. */
  void (*ask)(ts_engine*, int32_t question, int32_t a, int32_t b, ts_answer* answer, const ts_sink* sink);
  /* Version 2, or NULL: answers one question about many pairs, with the answers that `ask` gives. No scene is loaded
   * then. `answers` holds batch->count answers, each as for `ask`; without an `ns` they share the time of the call
   * equally. The host asks in batches where it has several pairs to ask about. If the call crashes, hangs or throws,
   * it asks about each pair alone, through `ask`. */
  void (*ask_many)(ts_engine*, const ts_batch* batch, ts_answer* answers, const ts_batch_sink* sink);
  void (*reserved[7])(void); /* null */
} ts_plugin;

/* The one symbol that every plug-in must export. Symbols keep their names in all versions. */
TS_EXPORT const ts_plugin* touchstone_plugin_v1(void);

/* Optional: called once, before touchstone_plugin_v1, with the host's TS_ABI_MINOR. Hosts of minor 0 do not call it. */
TS_EXPORT void touchstone_host_v1(uint32_t minor);

#ifdef __cplusplus
}
#endif
#endif

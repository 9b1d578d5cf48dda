/* touchstone_engine.h — the interface of an engine plug-in. Plain C, ABI version 1.
 *
 * A plug-in is a shared object that exports one function, `touchstone_plugin_v1`. It returns a table that lists one or
 * more engines. The host process loads the plug-in, creates one engine, loads scenes and asks questions. The plug-in
 * may crash, hang, print or throw: the host is a separate process, and all of that is recorded as an observation.
 * The process that loads the plug-in is forked before `create`, and again after each crash: start threads in `create`
 * or later, not while the library is loaded.
 *
 * Units and frames: lengths in the scene's unit, angles in radians, world frame unless stated otherwise, column
 * vectors, right-handed. Quaternions are x, y, z, w, non-zero and NOT necessarily unit. Matrices are row-major.
 * Arrays passed by the host stay valid until the function returns; those of a scene, until it is unloaded.
 *
 * Within version 1 everything here keeps its name, place and meaning, so a plug-in built with an earlier header
 * continues to work. Two things may change: structures filled in by the host (ts_scene, ts_sink, ts_received) may get
 * new fields at their ends, and enumerations new values at theirs. Each such change increments the minor version; a
 * plug-in that uses one learns the host's minor version by exporting touchstone_host_v1 (at the end of this header).
 */
#ifndef TOUCHSTONE_ENGINE_H
#define TOUCHSTONE_ENGINE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TS_ABI_VERSION 1
/* 1: ts_received.other_shape, and received hulls with a different number of vertices
 * 2: "more_shapes" of a card, TS_ROUNDED_BOX */
#define TS_ABI_MINOR 2

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
  TS_MESH = 8,       /* vertices, triangles: a surface */
  TS_ROUNDED_BOX = 9 /* size[0..2] = half extents of a box, size[3] = radius: all points within it of the box */
};
/* Every engine is sent the kinds up to this one, and those after it that its card lists ("more_shapes"). */
#define TS_LAST_COMMON_SHAPE TS_MESH
/* The last kind of this header. */
#define TS_LAST_SHAPE TS_ROUNDED_BOX

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

typedef struct ts_body {
  int32_t shape;
  int32_t is_static;
  int32_t has_motion;
  int32_t group; /* two bodies with the same group >= 0 are never paired */
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
  TS_SWEPT_CANDIDATES = 6
}; /* Questions may be added: leave the answer to an unknown one unchanged, i.e. TS_UNSUPPORTED. */

enum ts_outcome {
  TS_ANSWERED = 0,
  TS_UNSUPPORTED = 1,
  TS_NOT_CONVERGED = 2,
  TS_INVALID_INPUT = 3,
  TS_THREW = 4
};

/* Which fields of an answer are set. Fields that are not set are not judged: leave out whatever the engine's own
 * documentation disclaims. */
enum ts_has {
  TS_HAS_OVERLAP = 1,
  TS_HAS_DISTANCE = 2,
  TS_HAS_POINTS = 4,
  TS_HAS_NORMAL = 8,
  TS_HAS_DEPTH = 16,
  TS_HAS_TOI = 32 /* for TS_TIME_OF_IMPACT: set = hit at `toi`, not set = "no hit" */
};

typedef struct ts_answer {
  int32_t outcome;
  uint32_t has;
  int32_t overlap;
  int32_t reserved;
  double distance;   /* signed: a negative value is minus the depth */
  double point_a[3]; /* witness on A, world */
  double point_b[3]; /* witness on B, world */
  double normal[3];  /* unit, world, from A to B: B moves along +normal to separate */
  double depth;      /* >= 0: how far all of B must move along `normal` to separate from A */
  double toi;
  double claimed_tolerance; /* absolute: margin and solver tolerance that the engine's documentation claims for this
                               answer on these shapes; 0 if it claims none beyond arithmetic. Believed only if the
                               card has a `source`; above 1e-2 L it is shown beside the verdict */
  char detail[128];         /* zero-terminated message for people */
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

typedef struct ts_engine ts_engine; /* yours */

typedef struct ts_plugin {
  uint32_t abi_version; /* TS_ABI_VERSION */
  uint32_t engine_count;
  /* JSON card of the i-th engine, an object with these fields and no others:
   *   "name", "library", "version", "settings": strings; the name must not be empty
   *   "source": string: where the documentation makes the claims in claimed_tolerance; if empty, they are not
   * believed "unit_roundoff": of its arithmetic, 1.1102230246251565e-16 for doubles, 5.960464477539063e-08
   * for floats; at most 2^-8 "tau_factor": the error allowed for rounding, in units of unit_roundoff times
   * the scale L of the pair; typically 64; at most 16384, and at most 0.01 after multiplication by
   * unit_roundoff "complete_manifolds", optional: true if manifolds cover the whole contact region, which is
   * then checked "more_shapes", optional, since minor 2: the kinds after TS_LAST_COMMON_SHAPE that the engine
   * takes, by the names of the scene's JSON form, e.g. ["rounded_box"]. For a scene with any other kind after
   * TS_LAST_COMMON_SHAPE the host answers "unsupported" and does not call `load` */
  const char* (*card)(uint32_t i);
  ts_engine* (*create)(uint32_t i);
  void (*destroy)(ts_engine*);
  /* Loads the scene; may call `received`. Returns a ts_outcome; if not TS_ANSWERED, detail (256 bytes) says why. */
  int32_t (*load)(ts_engine*, const ts_scene*, const ts_received* received, char* detail);
  void (*unload)(ts_engine*);
  /* Answers one question about the loaded scene. `answer` is zeroed on entry, with numbers NaN and outcome
   * TS_UNSUPPORTED. */
  void (*ask)(ts_engine*, int32_t question, int32_t a, int32_t b, ts_answer* answer, const ts_sink* sink);
} ts_plugin;

/* The one symbol that every plug-in must export. */
TS_EXPORT const ts_plugin* touchstone_plugin_v1(void);

/* Optional: called once, before touchstone_plugin_v1, with the host's TS_ABI_MINOR. Hosts of minor 0 do not call it. */
TS_EXPORT void touchstone_host_v1(uint32_t minor);

#ifdef __cplusplus
}
#endif
#endif

/* clang-format off */
/* Logs the live queries of a program to a collision engine as JSON lines, which `touchstone replay FILE.jsonl`
 * judges later without the engine. Plain C, no library needed.
 *   FILE *log = fopen("capture.jsonl", "w");
 *   double half[] = {1, 1, 1}, radius = 0.5, distance = ...;          (what the engine answered)
 *   touchstone_captured_body a = {"box", half, 3}, b = {"sphere", &radius, 1};
 *   b.pose = pose_of_b;                                 (x y z and quaternion x y z w; NULL: identity)
 *   touchstone_captured_answer says = {0};
 *   says.distance = &distance;                           (what stays NULL is not stated)
 *   touchstone_capture(log, "my engine 1.2", &a, &b, &says);
 *
 * Returns 0, or -1 if it could not be written. Threads must not share a FILE without a lock. */
#ifndef TOUCHSTONE_CAPTURE_H
#define TOUCHSTONE_CAPTURE_H
#include <stdio.h>
typedef struct touchstone_captured_body {
  const char *type;      /* sphere, box, capsule, cylinder, cone, ellipsoid, hull, half_space, mesh, rounded_box, solid_mesh */
  const double *numbers; /* the fields of `touchstone answer --help` in order; hull, mesh: the points */
  size_t count;          /* how many numbers */
  const double *pose;    /* 7, or NULL */
  const double *motion;  /* linear and angular velocity over the step, 6, or NULL */
  const int *triangles;  /* of a mesh, three indices each, and their number */
  size_t triangle_count;
} touchstone_captured_body;

typedef struct touchstone_captured_answer {
  const int *overlap;      /* 0 or 1 */
  const double *distance, *depth; /* the distance is signed */
  const double *normal;    /* 3, from A to B */
  const double *witness;   /* 6: the points of A and B */
  int asked_for_impact;    /* then time_of_impact NULL means: no impact in the step */
  const double *time_of_impact;
} touchstone_captured_answer;

static void touchstone_put(FILE *f, double x) {
  char text[40], *c = text; /* written with a point in every locale */
  sprintf(text, "%.17g", x);
  if (x - x != 0) fputs(x != x ? "\"NaN\"" : x > 0 ? "\"Infinity\"" : "\"-Infinity\"", f);
  else for (; *c; ++c) fputc(*c == ',' ? '.' : *c, f);
}
/* ,"name":x or, for n > 1, a list; nothing for NULL */
static void touchstone_put_field(FILE *f, const char *name, const double *x, size_t n, int is_list) {
  size_t i;
  if (!x) return;
  fprintf(f, ",\"%s\":%s", name, is_list ? "[" : "");
  for (i = 0; i < n; ++i) {
    if (i) fputc(',', f);
    touchstone_put(f, x[i]);
  }
  if (is_list) fputc(']', f);
}
static void touchstone_put_body(FILE *f, const char *name, const touchstone_captured_body *b) {
  size_t i;
  fprintf(f, ",\"%s\":{\"type\":\"%s\"", name, b->type);
  touchstone_put_field(f, "numbers", b->numbers, b->count, 1);
  for (i = 0; i < 3 * b->triangle_count; ++i) fprintf(f, "%s%d", i ? "," : ",\"triangles\":[", b->triangles[i]);
  if (b->triangle_count) fputc(']', f);
  touchstone_put_field(f, "pose", b->pose, 7, 1);
  touchstone_put_field(f, "motion", b->motion, 6, 1);
  fputc('}', f);
}
static int touchstone_capture(FILE *f, const char *engine, const touchstone_captured_body *a,
                              const touchstone_captured_body *b, const touchstone_captured_answer *says) {
  fputs("{\"touchstone_query\":1,\"engine\":\"", f);
  for (; *engine; ++engine)
    if (*engine != '"' && *engine != '\\' && (unsigned char)*engine >= 0x20) fputc(*engine, f);
  fputc('"', f);
  touchstone_put_body(f, "a", a);
  touchstone_put_body(f, "b", b);
  fprintf(f, ",\"answer\":{\"overlap\":%s", !says->overlap ? "null" : *says->overlap ? "true" : "false");
  touchstone_put_field(f, "distance", says->distance, 1, 0);
  touchstone_put_field(f, "depth", says->depth, 1, 0);
  touchstone_put_field(f, "normal", says->normal, 3, 1);
  touchstone_put_field(f, "witness", says->witness, 6, 1);
  touchstone_put_field(f, "time_of_impact", says->time_of_impact, 1, 0);
  if (says->asked_for_impact && !says->time_of_impact) fputs(",\"time_of_impact\":null", f);
  fputs("}}\n", f);
  return fflush(f) == 0 && !ferror(f) ? 0 : -1;
}
#endif

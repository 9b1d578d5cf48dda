/* Logs answers of an engine that does not exist: of ten, two are wrong. */
#include "touchstone_capture.h"

int main(int argc, char **argv) {
  const double half[] = {1, 1, 1}, radius = 0.5, up[] = {0, 0, 1}, above[] = {0, 0, 1.75, 0, 0, 0, 1};
  const double inside[] = {0, 0, 1.25, 0, 0, 0, 1}, falls[] = {0, 0, -1, 0, 0, 0};
  const double rises[] = {0, 0, 1, 0, 0, 0};
  const double quarter = 0.25, zero = 0, nan = (zero + 1) / zero - (zero + 1) / zero;
  const double witness[] = {0, 0, 1, 0, 0, 1.25};
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, plane[] = {0, 0, 1, 0}, low[] = {0, 0, 3, 0, 0, 0, 1};
  const int yes = 1, triangle[] = {0, 1, 2};
  const double two_and_a_half = 2.5;
  touchstone_captured_body a = {"box", half, 3, 0, 0, 0, 0}, b = {"sphere", &radius, 1, above, 0, 0, 0};
  touchstone_captured_answer right = {0, &quarter, 0, up, witness, 0, 0}, wrong = {0, &zero, 0, up, 0, 0, 0};
  touchstone_captured_answer not_a_number = {0, &nan, 0, 0, 0, 0, 0}, deep = {&yes, 0, &quarter, up, 0, 0, 0};
  touchstone_captured_answer hit = {0, 0, 0, 0, 0, 1, &quarter}, none = {0, 0, 0, 0, 0, 1, 0};
  touchstone_captured_answer far = {0, &two_and_a_half, 0, 0, 0, 0, 0};
  const char *name = "my engine 1.2";
  FILE *f = argc == 2 ? fopen(argv[1], "w") : 0;
  int bad = f == 0;
  if (bad) return 1;
  bad |= touchstone_capture(f, name, &a, &b, &right);
  bad |= touchstone_capture(f, name, &a, &b, &wrong);
  bad |= touchstone_capture(f, name, &a, &b, &right);
  bad |= touchstone_capture(f, name, &a, &b, &not_a_number);
  b.motion = falls;
  bad |= touchstone_capture(f, name, &a, &b, &hit);
  b.pose = inside;
  b.motion = 0;
  bad |= touchstone_capture(f, name, &a, &b, &deep);
  b.pose = low;
  bad |= touchstone_capture(f, name, &b, &b, &(touchstone_captured_answer){&yes, 0, 0, 0, 0, 0, 0});
  a.type = "mesh";
  a.numbers = corners;
  a.count = 9;
  a.triangles = triangle;
  a.triangle_count = 1;
  bad |= touchstone_capture(f, name, &a, &b, &far);
  a.type = "half_space";
  a.numbers = plane;
  a.count = 4;
  a.triangle_count = 0;
  b.pose = above;
  b.motion = rises;
  bad |= touchstone_capture(f, name, &a, &b, &none);
  b.motion = 0;
  b.pose = low;
  bad |= touchstone_capture(f, name, &a, &b, &far);
  return fclose(f) != 0 || bad ? 1 : 0;
}

/* The C interface in forty lines: a gap, an impact, a ruling, a certificate. */
#include <stdio.h>
#include <string.h>

#include "touchstone.h"

static touchstone_shape *shape(const char *text) {
  touchstone_shape *s = NULL;
  if (touchstone_parse_shape(text, &s) != TOUCHSTONE_OK) fprintf(stderr, "%s\n", touchstone_last_error());
  return s;
}

int main(void) {
  const double above[7] = {0, 0, 1.75, 0, 0, 0, 1}, falls[6] = {0, 0, -1, 0, 0, 0};
  const char *certificate = "{\"kind\": \"separating_plane\", \"direction\": [0, 0, 1], \"offset\": 1.125}";
  touchstone_shape *box = shape("box 1 1 1"), *ball = shape("sphere 0.5");
  touchstone_gap gap;
  touchstone_impact impact;
  touchstone_stated says;
  int ruling, valid;
  if (!box || !ball) return 1;

  if (touchstone_gaps(box, NULL, ball, above, 1, 0, &gap) != TOUCHSTONE_OK) return 1;
  printf("gap %g, normal z %g\n", gap.lo, gap.normal[2]);
  if (touchstone_impacts(box, NULL, NULL, ball, above, falls, 1, &impact) != TOUCHSTONE_OK) return 1;
  printf("impact at %g\n", impact.t_lo);

  memset(&says, 0, sizeof says);
  says.stated = TOUCHSTONE_STATES_DISTANCE;
  says.distance = 0;
  if (touchstone_judge(box, NULL, NULL, ball, above, NULL, 1, &says, 0, 0, &ruling) != TOUCHSTONE_OK) return 1;
  printf("\"my engine said 0\": %s\n", ruling == TOUCHSTONE_WRONG ? "wrong" : "not wrong");
  if (touchstone_check(box, NULL, NULL, ball, above, NULL, certificate, &valid) != TOUCHSTONE_OK) return 1;
  printf("certificate: %s\n", valid ? "valid" : "not valid");

  touchstone_free_shape(box);
  touchstone_free_shape(ball);
  return 0;
}

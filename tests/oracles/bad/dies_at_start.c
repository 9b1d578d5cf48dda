/* Dies while it is loaded, like a library with a failing static initialiser. */
#include <stdio.h>
#include <stdlib.h>

__attribute__((constructor)) static void die(void) {
  fputs("bad: cannot live here\n", stderr);
  abort();
}

/* A library of native engines of another checkout, whose C++ types the host must not use. */
const char* touchstone_source_id_v1(void);
const char* touchstone_source_id_v1(void) { return "0123456789abcdef"; }

void* touchstone_native_engine(const char* name);
void* touchstone_native_engine(const char* name) {
  (void)name;
  return 0;
}

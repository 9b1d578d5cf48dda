// Entry point for libFuzzer and compatible fuzzers: tests the core against the referee and its own relations.
//   cmake --preset libfuzzer && cmake --build --preset libfuzzer
//   build/libfuzzer/bin/touchstone_fuzzer corpus fuzz/libfuzzer/seeds
//   -dict=fuzz/libfuzzer/touchstone_fuzzer.dict
#include <cstddef>
#include <cstdint>

#include "fuzz/libfuzzer/decode.h"
#include "oracles/core/core_engine.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const touchstone::EnginePtr core = touchstone::make_core_engine();
  touchstone::fuzz::judge_bytes({data, size}, core);
  return 0;
}

// Where recorded and published data lies: TS_SHARED_DATA in the environment, by default beside the checkout.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace touchstone::test {

inline std::filesystem::path shared_data() {
  const char* chosen = std::getenv("TS_SHARED_DATA");
  return chosen ? chosen : TS_SHARED_DATA;
}

}  // namespace touchstone::test

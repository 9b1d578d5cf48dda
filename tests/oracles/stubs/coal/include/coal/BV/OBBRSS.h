#pragma once
namespace coal {
struct OBBRSS {};
}  // namespace coal

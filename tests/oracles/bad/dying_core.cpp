// The core's library with a fault: its engines answer normally, but die, in the way that TS_DYING_CORE names,
// on the last question about a deadly scene.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include "oracles/abi/touchstone_engine.h"
#include "oracles/core/core_engine.h"

namespace touchstone {
namespace {

volatile std::uint64_t counted = 0;

[[gnu::noinline]] void eat_memory() {
  for (;;) {
    char* const block = static_cast<char*>(std::malloc(1 << 20));
    if (block) std::memset(block, 1, 1 << 20);
  }
}

std::string word_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text ? text : "";
}

/// TS_DEADLY=n: one scene in n is deadly. Without it, those whose body 0 lies at x = 666.
bool is_deadly(const Scene& s) {
  static const std::string every = word_of("TS_DEADLY");
  if (!every.empty()) return hash(s) % std::stoul(every) == 0;
  return !s.bodies.empty() && s.bodies[0].pose.translation.x() == 666;
}

}  // namespace

[[gnu::noinline]] void dies_in_the_core(const std::string& how) {
  if (how == "segv") *reinterpret_cast<volatile int*>(8) = 1;
  if (how == "abort") std::abort();
  while (how == "loop") counted = counted + 1;
  while (how == "wait") pause();
  if (how == "memory") eat_memory();
  if (how == "exit") _exit(0);
  if (how == "throw") throw std::runtime_error("thrown by an engine of the core");
  if (how != "once") return;
  // Only the first process dies here: a file keeps count.
  const int file = open(word_of("TS_DIED").c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
  if (file >= 0) *reinterpret_cast<volatile int*>(8) = 1;
}

namespace {

class Dying final : public NativeEngine {
 public:
  explicit Dying(std::unique_ptr<NativeEngine> inner) : inner_(std::move(inner)) {}
  const EngineCard& card() const override { return inner_->card(); }
  ReceivedScene received(const Scene& s) const override { return inner_->received(s); }
  void answer(const Case& c, const Tell& tell) override {
    inner_->answer(c, [&, left = c.queries.size()](Observation o) mutable {
      if (--left == 0 && is_deadly(c.scene)) dies_in_the_core(word_of("TS_DYING_CORE"));
      tell(std::move(o));
    });
  }

 private:
  std::unique_ptr<NativeEngine> inner_;
};

}  // namespace
}  // namespace touchstone

extern "C" TS_EXPORT touchstone::NativeEngine* touchstone_native_engine(const char* name) {
  auto engine = touchstone::make_native_core(name);
  return engine ? new touchstone::Dying(std::move(engine)) : nullptr;
}

#include "cli/command.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <thread>

namespace touchstone::cli {
namespace {

std::string& stored_program_name() {
  static std::string name = "touchstone";
  return name;
}

}  // namespace

void set_program_name(std::string name) { stored_program_name() = shell_word(name); }

const std::string& program_name() { return stored_program_name(); }

int processor_count() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

void add_jobs(CLI::App& app, int& jobs, const std::string& what) {
  jobs = processor_count();
  app.add_option("--jobs", jobs, what + " (default: one for each processor)")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

namespace {

template <class Number>
bool parses(const std::string& text, Number& value) {
  const auto r = std::from_chars(text.data(), text.data() + text.size(), value);
  return r.ec == std::errc{} && r.ptr == text.data() + text.size();
}

}  // namespace

CLI::Validator a_count() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t n = 0;
        return parses(text, n) && n > 0 ? std::string() : text + " is not a positive whole number in digits";
      },
      "COUNT");
}

CLI::Validator a_positive_number() {
  return CLI::Validator(
      [](std::string& text) {
        double x = 0;
        return parses(text, x) && x > 0 && std::isfinite(x) ? std::string()
                                                            : text + " is not a positive number";
      },
      "NUMBER");
}

namespace {

void on_signal(int) { interrupted = true; }

}  // namespace

std::atomic<bool> interrupted{false};

void catch_stop_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

}  // namespace touchstone::cli

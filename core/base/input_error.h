// The one exception for bad input: where it is (file, JSON path, field) and why. The command line turns it
// into one line on stderr and exit code 2.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace touchstone {

class InputError : public std::runtime_error {
 public:
  InputError(std::string place, std::string reason)
      : std::runtime_error(place.empty() ? reason : place + ": " + reason),
        place_(std::move(place)),
        reason_(std::move(reason)) {}
  const std::string& place() const { return place_; }
  const std::string& reason() const { return reason_; }
  /// The same error with `prefix` put in front of the place; for callers one level further out.
  InputError within(const std::string& prefix) const {
    return InputError(place_.empty() ? prefix : prefix + (place_.front() == '[' ? "" : ".") + place_, reason_);
  }

 private:
  std::string place_, reason_;
};

}  // namespace touchstone

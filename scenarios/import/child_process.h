// Work on a hostile file in a process of its own: a reader that is not ours may crash or never end.
#pragma once

#include <functional>
#include <string>

namespace touchstone {

/// What `work` returns in a forked child. An InputError that it throws is thrown here, with its place and
/// reason. Throws InputError about `file` when the child ends by a signal, or has used a minute of CPU time,
/// or cannot be started. What the child writes to stderr is lost.
std::string in_child_process(const std::string& file, const std::function<std::string()>& work);

}  // namespace touchstone

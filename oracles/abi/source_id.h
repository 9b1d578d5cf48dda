// Tells builds apart. Harness, worker and the engines of this checkout exchange C++ types and messages whose
// layout changes with the sources, so a mixture of builds would answer nonsense.
#pragma once

namespace touchstone {

/// 16 hexadecimal digits: a hash of the sources that all of them share (cmake/shared_sources.cmake) and of
/// the options that change their types. The build writes its definition (cmake/source_id.cmake).
const char* source_id();

/// The same for the sources alone. The messages between harness and worker depend on no option, so that a
/// worker of another machine or arithmetic can be asked.
const char* message_id();

/// The name, with C linkage, under which a library of this checkout exports source_id(). Plug-ins built
/// elsewhere need not: the C ABI keeps its meaning.
inline constexpr const char* source_id_symbol = "touchstone_source_id_v1";

}  // namespace touchstone

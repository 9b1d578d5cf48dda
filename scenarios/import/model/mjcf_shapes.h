// The shapes of MJCF geoms.
#pragma once

#include <optional>

#include "core/shape/shape.h"
#include "scenarios/import/model/mjcf_document.h"

namespace touchstone {

/// The shape of a geom; `fromto` replaces its pose. Nothing for what cannot be represented, if
/// ImportContext::refuse lets it pass. Throws InputError.
std::optional<Shape> mjcf_shape(const MjcfElement& geom, const MjcfDocument& document, ImportContext& context,
                                Pose& pose);

/// A sphere, capsule, cylinder, box or ellipsoid of MJCF's sizes. Throws InputError at `e` for too few.
Shape sized_shape(const std::string& type, const std::vector<double>& size, const XmlElement& e);

}  // namespace touchstone

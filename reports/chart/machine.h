// Describes the machine of a measurement: times mean nothing without it.
#pragma once

#include "reports/record/chart.h"

namespace touchstone::fuzz {

Machine this_machine();

}  // namespace touchstone::fuzz

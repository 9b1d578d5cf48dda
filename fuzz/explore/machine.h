// What is measured on: times mean nothing without it.
#pragma once

#include "fuzz/record/chart.h"

namespace touchstone::fuzz {

Machine this_machine();

}  // namespace touchstone::fuzz

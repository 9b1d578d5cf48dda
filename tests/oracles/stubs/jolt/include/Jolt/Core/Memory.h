#pragma once
#include "Jolt/Jolt.h"

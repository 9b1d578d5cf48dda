#pragma once
#define COAL_VERSION "0.0.1"

#pragma once
#include "tests/support/threads/tbb.hpp"

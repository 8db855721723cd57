// The cross-bilateral filter as a technique of its own (shared/filter/bilateral_filter.h).
#include "shared/filter/bilateral_filter.h"

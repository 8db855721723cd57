// The cross-bilateral filter as a technique of its own (shared/filter/bilateral_filter.h).
#include "bilateral/params.h"
#include "shared/filter/bilateral_filter.h"

// The cross-bilateral filter by itself.
#include "bilateral/params.h"
#include "shared/filter/bilateral_filter.h"

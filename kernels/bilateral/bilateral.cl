// The cross-bilateral filter by itself.
#include "bilateral/params.h"

typedef BilateralParams Params;

#include "shared/filter/bilateral_filter.h"

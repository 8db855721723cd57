#include "estimators/obscurance_params.h"
#include "shared/sampling/ambient_occlusion.h"

#define HBAO_PLUS_PARAMS(P)                                                                  \
  REACH_PARAMS(P)                                                                            \
  OBSCURANCE_SEARCH_PARAMS(P)                                                                \
  P(int, power, 1, 1, 4, "", "exponent on the result: NVIDIA's library uses 2 for contrast") \
  OBSCURANCE_FALLOFF(P)

// Of multiview.
#define OTHER_VIEW_PARAMS(P) \
  P(choice, other_resolution, full, (full, half, quarter), "resolution at which the second view is read")

PARAMS(HbaoPlusParams, HBAO_PLUS_PARAMS)
PARAMS(OtherViewParams, OTHER_VIEW_PARAMS)

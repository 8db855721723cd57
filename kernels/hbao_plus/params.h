#include "estimators/obscurance_params.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/stereo/params.h"

#define HBAO_PLUS_PARAMS(P)                                                                  \
  REACH_PARAMS(P)                                                                            \
  OBSCURANCE_SEARCH_PARAMS(P)                                                                \
  P(int, power, 1, 1, 4, "", "exponent on the result: NVIDIA's library uses 2 for contrast") \
  OBSCURANCE_FALLOFF(P)

#define SD_HBAO_PLUS_PARAMS(P) \
  HBAO_PLUS_PARAMS(P)          \
  STOCHASTIC_PARAMS(P)

#define MULTIVIEW_PARAMS(P) \
  SD_HBAO_PLUS_PARAMS(P)    \
  P(choice, other_resolution, full, (full, half, quarter), "resolution at which the second view is read")

#define STEREO_AO_PARAMS(P) \
  HBAO_PLUS_PARAMS(P)       \
  STEREO_PARAMS(P)

#define STEREO_SD_HBAO_PLUS_PARAMS(P) \
  SD_HBAO_PLUS_PARAMS(P)              \
  STEREO_PARAMS(P)

PARAMS(HbaoPlusParams, HBAO_PLUS_PARAMS)
PARAMS(SdHbaoPlusParams, SD_HBAO_PLUS_PARAMS)
PARAMS(MultiviewParams, MULTIVIEW_PARAMS)
PARAMS(StereoAoParams, STEREO_AO_PARAMS)
PARAMS(StereoSdHbaoPlusParams, STEREO_SD_HBAO_PLUS_PARAMS)

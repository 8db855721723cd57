// All pictures of frames for people, drawn with OpenCV.
#pragma once

#include "gloam/contact_sheet.h"
#include "gloam/difference_picture.h"
#include "gloam/explanation.h"
#include "gloam/plane_picture.h"
#include "gloam/sequence_plot.h"
#include "gloam/view_pictures.h"

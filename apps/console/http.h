#pragma once

#include <httplib.h>
#undef _res  // a macro of <resolv.h>, a name in Eigen

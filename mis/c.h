/* mis for hosts in C, in one include. */
#ifndef MIS_C_H
#define MIS_C_H

#include "mis/bind/c.h"

#endif

/// @file prelude.h What Sony's headers and newlib bring along, and other people's objects therefore rely on. object.mk
/// includes it before everything else; RCServer and the project's other objects do without.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_PRELUDE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_PRELUDE_H

#include <strings.h>

#include <iostream>
#include <list>
#include <map>
#include <string>

using namespace std;

#define stricmp strcasecmp

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_PRELUDE_H

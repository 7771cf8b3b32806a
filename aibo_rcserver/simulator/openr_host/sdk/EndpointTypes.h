/// @file EndpointTypes.h
#ifndef OPENR_ENDPOINTTYPES_H
#define OPENR_ENDPOINTTYPES_H

enum { EndpointType_TCP = 1, EndpointType_UDP = 2 };

#endif  // OPENR_ENDPOINTTYPES_H

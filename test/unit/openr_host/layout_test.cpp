// The layouts that the SDK's documentation gives. They are checked when this is compiled.
#include <OPENR/ODataFormats.h>
#include <OPENR/OPrimitiveControl.h>
#include <TCPEndpointMsg.h>

#include <cstddef>
#include <type_traits>

static_assert(sizeof(byte) == 1 && sizeof(word) == 2 && sizeof(longword) == 4 && sizeof(slongword) == 4);
static_assert(std::is_unsigned<longword>::value && std::is_signed<slongword>::value);
static_assert(sizeof(OStatus) == 4 && sizeof(OID) == 4 && sizeof(OPrimitiveID) == 4 && sizeof(ODataType) == 4);

static_assert(sizeof(ODataVectorInfo) == 192);
static_assert(offsetof(ODataVectorInfo, optional) == 192 - 128);
static_assert(sizeof(OCommandInfo) == 32);
static_assert(sizeof(OCommandValue) == 8 && sizeof(OJointCommandValue2) == 8);
static_assert(sizeof(OJointCommandValue4) == 8 && sizeof(OLEDCommandValue2) == 8 && sizeof(OLEDCommandValue3) == 8);
static_assert(sizeof(OCommandData) == 16 * 8);
static_assert(sizeof(OSensorValue) == 16 && sizeof(OJointValue) == 16);
static_assert(sizeof(OSensorFrameData) == 16 * 16);
static_assert(sizeof(OFbkImageInfo) == 32);
static_assert(sizeof(OFbkImageVectorData) == 192 + 4 * 32);
static_assert(sizeof(OPrimitiveControl_CameraParam) == 4);

static_assert(TCP_BUFFER_INVALID == 16 && TCP_OPERATION_INVALID == 17 && TCP_ADDRESSINUSE == 6);

// Messages are copied byte by byte.
static_assert(std::is_trivially_destructible<TCPEndpointSendMsg>::value);
static_assert(!std::is_polymorphic<TCPEndpointSendMsg>::value);

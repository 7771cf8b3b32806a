/// @file sizes.cc
/// Stops the build if a class that programs share with OPEN-R's libraries has another size than there. The libraries
/// were built with GCC 3.3. A comparison of the classes of both compilers found the same sizes, those of OSubject and
/// OObserver only with this project's std::list.
#include <EndpointTypes.h>
#include <IPAddress.h>
#include <OPENR/ODataFormats.h>
#include <OPENR/OFbkImage.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OPENR.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OPower.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>
#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>
#include <ant.h>

#define EXPECT_SIZE(type, bytes) typedef char type##_has_another_size[sizeof(type) == (bytes) ? 1 : -1]

EXPECT_SIZE(DataManager, 8);
EXPECT_SIZE(IPAddress, 4);
EXPECT_SIZE(MemoryMapAgent, 1);
EXPECT_SIZE(MemoryRegionID, 4);
EXPECT_SIZE(OBootCondition, 16);
EXPECT_SIZE(OCdtInfo, 144);
EXPECT_SIZE(OCdtVectorData, 1344);
EXPECT_SIZE(OCommandData, 128);
EXPECT_SIZE(OCommandInfo, 32);
EXPECT_SIZE(OCommandValue, 8);
EXPECT_SIZE(OCommandVectorData, 224);
EXPECT_SIZE(OConnectMessage, 144);
EXPECT_SIZE(OControlMessage, 156);
EXPECT_SIZE(ODataVectorInfo, 192);
EXPECT_SIZE(OFbkImage, 16);
EXPECT_SIZE(OFbkImageInfo, 32);
EXPECT_SIZE(OFbkImageVectorData, 224);
EXPECT_SIZE(OJointCommandValue2, 8);
EXPECT_SIZE(OJointCommandValue4, 8);
EXPECT_SIZE(OJointValue, 16);
EXPECT_SIZE(OLEDCommandValue2, 8);
EXPECT_SIZE(OLEDCommandValue3, 8);
EXPECT_SIZE(ONotifyEvent, 76);
EXPECT_SIZE(ONotifyMessage, 224);
EXPECT_SIZE(OObject, 8);
EXPECT_SIZE(OObserver, 364);
EXPECT_SIZE(OObserverInfo, 4);
EXPECT_SIZE(OPowerStatus, 20);
EXPECT_SIZE(OPowerStatusMessage, 24);
EXPECT_SIZE(OPrimitiveControl_CameraParam, 4);
EXPECT_SIZE(OPrimitiveID, 4);
EXPECT_SIZE(OReadyEvent, 16);
EXPECT_SIZE(OReadyMessage, 72);
EXPECT_SIZE(OSensorFrameData, 256);
EXPECT_SIZE(OSensorFrameInfo, 32);
EXPECT_SIZE(OSensorFrameVectorData, 224);
EXPECT_SIZE(OSensorValue, 16);
EXPECT_SIZE(OServiceEntry, 8);
EXPECT_SIZE(OSubject, 504);
EXPECT_SIZE(OSubjectInfo, 12);
EXPECT_SIZE(OSystemEvent, 12);
EXPECT_SIZE(ObserverID, 8);
EXPECT_SIZE(RCRegion, 24);
EXPECT_SIZE(SharedMemoryHeader, 16);
EXPECT_SIZE(SubjectID, 8);
EXPECT_SIZE(TCPEndpointCloseMsg, 56);
EXPECT_SIZE(TCPEndpointListenMsg, 60);
EXPECT_SIZE(TCPEndpointReceiveMsg, 60);
EXPECT_SIZE(TCPEndpointSendMsg, 56);
EXPECT_SIZE(UDPEndpointBindMsg, 52);
EXPECT_SIZE(UDPEndpointCloseMsg, 52);
EXPECT_SIZE(UDPEndpointReceiveMsg, 60);
EXPECT_SIZE(UDPEndpointSendMsg, 60);
EXPECT_SIZE(antEnvCreateEndpointMsg, 60);
EXPECT_SIZE(antEnvCreateSharedBufferMsg, 64);
EXPECT_SIZE(antEnvDestroySharedBufferMsg, 60);
EXPECT_SIZE(antEnvMsg, 40);
EXPECT_SIZE(antModuleRef, 8);
EXPECT_SIZE(antSharedBuffer, 16);
EXPECT_SIZE(antStackRef, 8);
EXPECT_SIZE(long, 4);
EXPECT_SIZE(size_t, 4);
typedef void (OObject::*Method)(const OSystemEvent&);
EXPECT_SIZE(Method, 8);

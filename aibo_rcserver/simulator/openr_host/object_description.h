/// @file object_description.h
/// What the machine needs to create an object. generate_stub writes it from stub.cfg.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECT_DESCRIPTION_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECT_DESCRIPTION_H

#include <OID.h>
#include <OPENR/OObject.h>
#include <ant.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace openr_host {

/// A service that sends data. A `null` function of stub.cfg is empty here.
struct SubjectDescription {
  std::string service;  ///< "Object.Name.Data.S"
  std::function<void(OObject&, const OControlEvent&)> control;
  std::function<void(OObject&, const OReadyEvent&)> ready;
};

/// A service that receives data.
struct ObserverDescription {
  std::string service;  ///< "Object.Name.Data.O"
  std::function<void(OObject&, const OConnectEvent&)> connect;
  std::function<void(OObject&, const ONotifyEvent&)> notify;
};

struct ObjectDescription {
  std::shared_ptr<void> library;  ///< keeps the loaded code in memory; the first member, so that it is destroyed last
  std::string name;
  std::vector<SubjectDescription> subjects;                             ///< in the order of sbjNAME
  std::vector<ObserverDescription> observers;                           ///< in the order of obsNAME
  std::vector<std::function<void(OObject&, ANTENVMSG)>> extra_entries;  ///< in the order of entryNAME; may be empty
  std::function<std::unique_ptr<OObject>()> create;
};

/// The OID of the n-th object of a system, from 1. On the robot an OID is an address; here it is a number.
inline OID oidOf(std::size_t number) {
  return OID(reinterpret_cast<void*>(number));
}

inline std::size_t numberOf(const OID& oid) {
  return reinterpret_cast<std::size_t>(oid.GetAddress());
}

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECT_DESCRIPTION_H

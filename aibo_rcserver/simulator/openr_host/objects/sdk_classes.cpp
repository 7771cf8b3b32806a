// The SDK's classes OObject, OSubject, OObserver and RCRegion.
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>

#include <cstring>
#include <new>
#include <stdexcept>

#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/objects/system.h"

namespace {

/// Returns the gate's service, which the object must have registered.
template <typename Service>
Service& registered(Service* service) {
  if (service == nullptr) {
    throw std::logic_error("a subject or observer is used before REGISTER_ALL_ENTRY");
  }
  return *service;
}

}  // namespace

OObject::OObject() {}

OObject::~OObject() {}

OStatus OObject::DoInit(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoStart(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoStop(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoDestroy(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OSubject::OSubject() : service_(nullptr) {}

OSubject::~OSubject() {
  delete service_;
}

void OSubject::Register(OID object, int index) {
  if (service_ == nullptr) {
    openr_host::System& system = openr_host::System::current();
    service_ = new openr_host::SubjectService(system, {object, static_cast<Selector>(index)});
    system.add(*service_);
  }
}

OStatus OSubject::ClearBuffer() {
  registered(service_).clear();
  return oSUCCESS;
}

OStatus OSubject::SetData(RCRegion* region) {
  registered(service_).setData(region);
  return oSUCCESS;
}

OStatus OSubject::SetData(const void* data, size_t size) {
  auto* region = new RCRegion(size);
  std::memcpy(region->Base(), data, size);
  const OStatus status = SetData(region);
  region->RemoveReference();
  return status;
}

OStatus OSubject::NotifyObservers() {
  registered(service_).notifyAll();
  return oSUCCESS;
}

int OSubject::IsReady() const {
  return registered(service_).isAnyReady() ? 1 : 0;
}

OObserver::OObserver() : service_(nullptr) {}

OObserver::~OObserver() {
  delete service_;
}

void OObserver::Register(OID object, int index) {
  if (service_ == nullptr) {
    openr_host::System& system = openr_host::System::current();
    service_ = new openr_host::ObserverService(system, {object, static_cast<Selector>(index)});
    system.add(*service_);
  }
}

OStatus OObserver::AssertReady() {
  registered(service_).announceReady(true);
  return oSUCCESS;
}

OStatus OObserver::AssertReady(const SubjectID& subject) {
  registered(service_).announceReady(subject, true);
  return oSUCCESS;
}

OStatus OObserver::DeassertReady() {
  registered(service_).announceReady(false);
  return oSUCCESS;
}

OStatus OObserver::DeassertReady(const SubjectID& subject) {
  registered(service_).announceReady(subject, false);
  return oSUCCESS;
}

RCRegion::RCRegion(size_t size)
    : memory_id_(0),
      offset_(0),
      base_(static_cast<char*>(::operator new(size))),
      size_(size),
      owns_memory_(true),
      references_(1) {
  std::memset(base_, 0, size);
}

RCRegion::RCRegion(MemoryRegionID memID, size_t offset, void* base, size_t size)
    : memory_id_(memID),
      offset_(offset),
      base_(static_cast<char*>(base)),
      size_(size),
      owns_memory_(false),
      references_(1) {}

RCRegion::~RCRegion() {
  if (owns_memory_) {
    ::operator delete(base_);
  }
}

void RCRegion::AddReference() {
  ++references_;
}

void RCRegion::RemoveReference() {
  if (--references_ == 0) {
    delete this;
  }
}

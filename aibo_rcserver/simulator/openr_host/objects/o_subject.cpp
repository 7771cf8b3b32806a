#include <OPENR/OSubject.h>

#include <cstring>
#include <stdexcept>

#include "simulator/openr_host/objects/subject_service.h"
#include "simulator/openr_host/system.h"

namespace {

openr_host::SubjectService& registered(openr_host::SubjectService* service) {
  if (service == nullptr) {
    throw std::logic_error("a subject is used before REGISTER_ALL_ENTRY");
  }
  return *service;
}

}  // namespace

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

void OSubject::Enable(bool enabled) {
  registered(service_).enable(enabled);
}

OStatus OSubject::SetData(RCRegion* region) {
  registered(service_).setData(region);
  return oSUCCESS;
}

OStatus OSubject::SetData(const ObserverID& observer, RCRegion* region) {
  registered(service_).setData(observer, region);
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

OStatus OSubject::NotifyObserver(const ObserverID& observer) {
  registered(service_).notify(observer);
  return oSUCCESS;
}

int OSubject::IsReady(const ObserverID& observer) const {
  return ReadyStatus(observer) > 0 ? 1 : 0;
}

int OSubject::IsAnyReady() const {
  return registered(service_).isAnyReady() ? 1 : 0;
}

int OSubject::IsAllReady() const {
  return registered(service_).isAllReady() ? 1 : 0;
}

int OSubject::ReadyStatus(const ObserverID& observer) const {
  switch (registered(service_).readiness(observer)) {
    case openr_host::Readiness::kAssertReady:
      return 1;
    case openr_host::Readiness::kDeassertReady:
      return -1;
    case openr_host::Readiness::kUnknown:
      break;
  }
  return 0;
}

OStatus OSubject::SetBufferSize(size_t size) {
  if (size == 0) {
    return oINVALID_ARG;
  }
  registered(service_).setBufferSize(size);
  return oSUCCESS;
}

size_t OSubject::GetBufferSize() const {
  return registered(service_).bufferSize();
}

size_t OSubject::RemainBuffer(const ObserverID& observer) const {
  return registered(service_).roomFor(observer);
}

OStatus OSubject::ClearBuffer() {
  registered(service_).clear();
  return oSUCCESS;
}

#include <OPENR/OObserver.h>

#include <stdexcept>

#include "simulator/openr_host/objects/observer_service.h"
#include "simulator/openr_host/system.h"

namespace {

openr_host::ObserverService& registered(openr_host::ObserverService* service) {
  if (service == nullptr) {
    throw std::logic_error("an observer is used before REGISTER_ALL_ENTRY");
  }
  return *service;
}

}  // namespace

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

void OObserver::SetBufCtrlParam(size_t skip, size_t min, size_t max) {
  registered(service_).setBufferControl({skip, min, max});
}

int OObserver::NumberOfSubjects() const {
  return registered(service_).numberOfSubjects();
}

#include "couplers/contacts.hpp"

#include <fmt/format.h>

namespace sprekk::couplers {

namespace {

const std::string& name_of(FractureContact& contact) { return contact.traction().spec().owner; }

}  // namespace

Contacts::Contacts(const CouplerContext& context)
    : contacts_(context.all<FractureContact>()), of_cell_(context.mesh.fracture_cell_count(), nullptr) {
  std::vector<FractureContact*> taken(of_cell_.size(), nullptr);
  for (FractureContact* contact : contacts_)
    for (int i = 0; i < context.mesh.fracture_cell_count(); ++i) {
      if (!contact->is_on_fracture_cell(i)) continue;
      if (taken[i])
        throw InputError(context.origin,
                         fmt::format("fracture '{}' has two contacts",
                                     context.mesh.fractures[context.mesh.fracture_cells[i].fracture].name),
                         fmt::format("'{}' and '{}' are both on it", name_of(*taken[i]), name_of(*contact)),
                         "say by 'fractures' of each contact where it is");
      taken[i] = contact;
      of_cell_[i] = contact;
    }
}

void Contacts::need_all_fractures(const CouplerContext& context) const {
  if (empty()) return;
  for (int i = 0; i < context.mesh.fracture_cell_count(); ++i)
    if (!of_cell_[i])
      throw InputError(context.origin,
                       fmt::format("fracture '{}' has no contact",
                                   context.mesh.fractures[context.mesh.fracture_cells[i].fracture].name),
                       "nothing would keep its walls from passing through each other, and they would hold no shear",
                       "name it in 'fractures' of a contact in 'between'; with friction 0 walls hold no shear");
}

Vector Contacts::traction() const {
  Vector sum = contacts_.front()->traction().now();
  for (std::size_t k = 1; k < contacts_.size(); ++k) sum += contacts_[k]->traction().now();
  return sum;
}

Vector Contacts::jump() const {
  Vector sum = contacts_.front()->jump().now();
  for (std::size_t k = 1; k < contacts_.size(); ++k) sum += contacts_[k]->jump().now();
  return sum;
}

Vector Contacts::accepted_jump() const {
  Vector sum = contacts_.front()->jump().accepted();
  for (std::size_t k = 1; k < contacts_.size(); ++k) sum += contacts_[k]->jump().accepted();
  return sum;
}

std::uint64_t Contacts::traction_version() const {
  std::uint64_t sum = 0;
  for (FractureContact* contact : contacts_) sum += contact->traction().version();
  return sum;
}

}  // namespace sprekk::couplers

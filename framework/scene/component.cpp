#include "framework/scene/component.hpp"

namespace sprekk {

CouplerContext::CouplerContext(std::string name, const Mesh& mesh, FieldStore& fields, std::vector<Component*> between,
                               std::vector<Component*> scene, double start_time, Origin origin)
    : name(std::move(name)),
      mesh(mesh),
      fields(fields),
      start_time(start_time),
      origin(std::move(origin)),
      between_(std::move(between)),
      scene_(std::move(scene)) {}

std::string CouplerContext::between_text() const {
  std::string text;
  for (const Component* component : between_) text += (text.empty() ? "" : ", ") + component->name();
  return "[" + text + "]";
}

InputError CouplerContext::missing(const std::string& promise) const {
  return InputError(origin, "coupler " + name + " between " + between_text() + " lacks a component that " + promise,
                    "none of these does", "name one that does in `between`");
}

InputError CouplerContext::ambiguous(const std::string& promise) const {
  return InputError(
      origin, "coupler " + name + " between " + between_text() + " finds two components, each of which " + promise,
      "it joins one", "write one coupler for each");
}

void CouplerContext::check_all_used() const {
  for (Component* component : between_)
    if (!used_.count(component))
      throw InputError(origin, "coupler " + name + " has no use for component '" + component->name() + "'",
                       "it has none of the capabilities that the coupler joins", "remove it from `between`");
}

void CouplerContext::determine(Field& input) const {
  if (!input.determined_by().empty())
    throw InputError(origin, input.name() + " is determined twice",
                     "by coupler " + input.determined_by() + " and by coupler " + name, "remove one of them");
  input.determine(name);
}

}  // namespace sprekk

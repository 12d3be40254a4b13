// clang-format must refuse this file: K&R braces, two spaces, the asterisk at the name.
namespace ACS {
int Count(int *values) {
  return *values;
}
}

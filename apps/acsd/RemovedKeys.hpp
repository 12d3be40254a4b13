#pragma once

#include "common/ConfigSection.hpp"

namespace ACS::Acsd
{

/// Reports each key that is given and that earlier versions read, with what replaces it.
void ReportRemovedKeys(const Apps::ConfigSection& root);

} // namespace ACS::Acsd

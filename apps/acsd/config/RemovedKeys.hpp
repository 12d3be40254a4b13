#pragma once

#include "common/config/ConfigSection.hpp"

namespace ACS::Acsd
{

/// Reports each key that is given and that earlier versions read, with what replaces it.
void ReportRemovedKeys(const Apps::ConfigSection& root);

} // namespace ACS::Acsd

#pragma once

#include "view/TextTable.hpp"
#include <acs/core/Now.hpp>

namespace ACS::Acsctl
{

/// What a view needs besides the answer.
struct ViewContext
{
    Screen screen;
    Core::WallTime now; ///< Of acsd, from which ages are counted.
};

} // namespace ACS::Acsctl

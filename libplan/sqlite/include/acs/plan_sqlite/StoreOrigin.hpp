#pragma once

namespace ACS::Planning
{

/// What a store's file was when it was opened, or looked at.
struct StoreOrigin
{
    bool bNew = false;     ///< There was none, or an empty one.
    bool bRescued = false; ///< It was removed while it was open, and made again of the copy that was saved then.
    int foundVersion = 0;  ///< Of its schema; 0 for a new one.
    int version = 0;       ///< What it was brought to.

    bool operator==(const StoreOrigin&) const = default;
};

} // namespace ACS::Planning

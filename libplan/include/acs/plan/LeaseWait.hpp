#pragma once

#include <cstdint>
#include <string>

namespace ACS::Planning
{

/// Why a process does not lead.
enum class ELeaseWait : std::uint8_t
{
    NotRead,     ///< The lease was not read yet.
    StoreFailed, ///< The store cannot be used.
    OtherLeads,  ///< Another process leads.
    OtherConfig, ///< Likewise, with another LeaseClaim::config: this process cannot take over.
    OwnName,     ///< The lease has the name of this process: it is taken when it ends.
    TakesOver,   ///< It has the lease.
    Releases     ///< It releases the lease, or has lost it.
};

/// As above, with what belongs to it.
struct LeaseWait
{
    ELeaseWait reason = ELeaseWait::NotRead;
    std::string detail; ///< StoreFailed: the fault. OtherLeads, OtherConfig, OwnName: the leader. Otherwise empty.

    bool operator==(const LeaseWait&) const = default;
};

} // namespace ACS::Planning

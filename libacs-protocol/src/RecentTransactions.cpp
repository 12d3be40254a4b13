#include "RecentTransactions.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Protocol::Detail
{

void RecentTransactions::Remember(EAcsCommand command, std::string transactionID, bool bAwaited)
{
    if (_entries.size() >= CAPACITY)
    {
        _entries.pop_front();
    }
    _entries.push_back({command, std::move(transactionID), bAwaited});
}

void RecentTransactions::Forget(EAcsCommand command, std::string_view transactionID)
{
    std::erase_if(_entries, [command, transactionID](const Entry& entry) {
        return entry.command == command && entry.transactionID == transactionID;
    });
}

ELateAck RecentTransactions::TakeAck(EAcsCommand command, std::string_view transactionID)
{
    const auto found = std::find_if(_entries.begin(), _entries.end(), [command, transactionID](const Entry& entry) {
        return entry.command == command && entry.transactionID == transactionID;
    });
    if (found == _entries.end())
    {
        return ELateAck::Unknown;
    }
    return std::exchange(found->bAwaited, false) ? ELateAck::Late : ELateAck::Repeated;
}

} // namespace ACS::Protocol::Detail

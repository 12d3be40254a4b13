#include "RecentTransactions.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Protocol::Detail
{

RecentTransactions::RecentTransactions(std::size_t mostAwaited)
    : _mostAwaited(std::max<std::size_t>(mostAwaited, 1))
{
}

void RecentTransactions::Remember(EAcsCommand command, std::string transactionID, bool bAwaited)
{
    Entry entry{command, std::move(transactionID)};
    if (bAwaited)
    {
        Add(_awaited, _mostAwaited, std::move(entry));
        return;
    }
    Add(_answered, MOST_ANSWERED, std::move(entry));
}

void RecentTransactions::Forget(EAcsCommand command, std::string_view transactionID)
{
    Erase(_awaited, command, transactionID);
    Erase(_answered, command, transactionID);
}

ELateAck RecentTransactions::TakeAck(EAcsCommand command, std::string_view transactionID)
{
    if (Erase(_awaited, command, transactionID) > 0)
    {
        Add(_answered, MOST_ANSWERED, {command, std::string(transactionID)});
        return ELateAck::Late;
    }
    const bool bAnswered = std::ranges::any_of(_answered, [command, transactionID](const Entry& entry) {
        return entry.command == command && entry.transactionID == transactionID;
    });
    return bAnswered ? ELateAck::Repeated : ELateAck::Unknown;
}

void RecentTransactions::Add(std::deque<Entry>& entries, std::size_t most, Entry entry)
{
    if (entries.size() >= most)
    {
        entries.pop_front();
    }
    entries.push_back(std::move(entry));
}

std::size_t RecentTransactions::Erase(std::deque<Entry>& entries, EAcsCommand command, std::string_view transactionID)
{
    return std::erase_if(entries, [command, transactionID](const Entry& entry) {
        return entry.command == command && entry.transactionID == transactionID;
    });
}

} // namespace ACS::Protocol::Detail

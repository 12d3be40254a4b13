#include "AnswerStore.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Protocol::Detail
{

namespace
{

std::string MakeKey(EAcsCommand command, std::string_view transactionID)
{
    std::string key(GetText(command));
    key += ' ';
    key += transactionID;
    return key;
}

} // namespace

AnswerStore::AnswerStore(std::chrono::milliseconds memory, std::size_t capacity)
    : _memory(memory),
      _capacity(std::max<std::size_t>(capacity, 1))
{
}

AnswerStore::Entry* AnswerStore::FindOrNull(EAcsCommand command, std::string_view transactionID, Core::Now now)
{
    Forget(now);
    const auto found = _entries.find(MakeKey(command, transactionID));
    return found == _entries.end() ? nullptr : &found->second;
}

void AnswerStore::Insert(EAcsCommand command, std::string_view transactionID, bool bLegacyName, Core::Now now)
{
    if (_order.size() >= _capacity)
    {
        _entries.erase(_order.front());
        _order.pop_front();
    }
    std::string key = MakeKey(command, transactionID);
    const bool bNew = _entries.insert_or_assign(key, Entry{{}, now.steady, bLegacyName}).second;
    if (bNew)
    {
        _order.push_back(std::move(key));
    }
}

void AnswerStore::Forget(Core::Now now)
{
    while (!_order.empty() && _entries.at(_order.front()).receivedAt + _memory < now.steady)
    {
        _entries.erase(_order.front());
        _order.pop_front();
    }
}

} // namespace ACS::Protocol::Detail

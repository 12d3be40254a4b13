#include "TransactionMemory.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Protocol::Detail
{

std::string MakeTransactionKey(EAcsCommand command, std::string_view transactionID)
{
    std::string key(GetText(command));
    key += ' ';
    key += transactionID;
    return key;
}

TransactionMemory::TransactionMemory(std::size_t capacity, std::size_t maximumBytes)
    : _capacity(std::max<std::size_t>(capacity, 1)),
      _maximumBytes(maximumBytes)
{
}

bool TransactionMemory::TryInsert(EAcsCommand command, std::string_view transactionID)
{
    const auto [place, bNew] = _answers.try_emplace(MakeTransactionKey(command, transactionID));
    if (!bNew)
    {
        return false;
    }
    _order.push_back(&place->first);
    if (_order.size() > _capacity)
    {
        EraseOldest();
    }
    return true;
}

void TransactionMemory::KeepAnswer(EAcsCommand command, std::string_view transactionID, GivenAnswer answer)
{
    static_cast<void>(TryInsert(command, transactionID)); // it may have been dropped while it waited
    std::optional<GivenAnswer>& kept = _answers.find(MakeTransactionKey(command, transactionID))->second;
    _bytes -= kept.has_value() ? kept->message.size() : 0;
    _bytes += answer.message.size();
    kept = std::move(answer);
    while (_bytes > _maximumBytes && _order.size() > 1)
    {
        EraseOldest();
    }
}

const GivenAnswer* TransactionMemory::FindAnswerOrNull(EAcsCommand command, std::string_view transactionID) const
{
    const auto found = _answers.find(MakeTransactionKey(command, transactionID));
    return found == _answers.end() || !found->second.has_value() ? nullptr : &*found->second;
}

void TransactionMemory::EraseOldest()
{
    const auto found = _answers.find(*_order.front());
    _bytes -= found->second.has_value() ? found->second->message.size() : 0;
    _answers.erase(found);
    _order.pop_front();
}

} // namespace ACS::Protocol::Detail

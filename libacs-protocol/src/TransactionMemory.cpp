#include "TransactionMemory.hpp"

#include <algorithm>

namespace ACS::Protocol::Detail
{

std::string MakeTransactionKey(EAcsCommand command, std::string_view transactionID)
{
    std::string key(GetText(command));
    key += ' ';
    key += transactionID;
    return key;
}

TransactionMemory::TransactionMemory(std::size_t capacity)
    : _capacity(std::max<std::size_t>(capacity, 1))
{
}

bool TransactionMemory::TryInsert(EAcsCommand command, std::string_view transactionID)
{
    const auto [place, bNew] = _keys.insert(MakeTransactionKey(command, transactionID));
    if (!bNew)
    {
        return false;
    }
    _order.push_back(&*place);
    if (_order.size() > _capacity)
    {
        _keys.erase(_keys.find(*_order.front()));
        _order.pop_front();
    }
    return true;
}

} // namespace ACS::Protocol::Detail

#include "AnswerCache.hpp"

#include "TransactionMemory.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Protocol::Detail
{

namespace
{

/// Answering it again is harmless.
bool IsQuestion(EAcsCommand command)
{
    return command == EAcsCommand::RequestAcsPlans || command == EAcsCommand::RequestAcsPlanHistory
        || command == EAcsCommand::RequestAcsErrorList;
}

} // namespace

AnswerCache::AnswerCache(std::chrono::milliseconds memory, std::size_t capacity, std::size_t maximumBytes)
    : _memory(memory),
      _capacity(std::max<std::size_t>(capacity, 1)),
      _maximumBytes(maximumBytes)
{
}

const AnswerCache::Entry* AnswerCache::FindOrNull(EAcsCommand command, std::string_view transactionID, Core::Now now)
{
    Forget(now);
    const auto found = _entries.find(MakeTransactionKey(command, transactionID));
    return found == _entries.end() ? nullptr : &found->second;
}

void AnswerCache::Insert(
    EAcsCommand command,
    std::string_view transactionID,
    bool bLegacyName,
    std::uint64_t digest,
    Core::Now now)
{
    if (_order.size() >= _capacity)
    {
        EraseLeastNeeded();
    }
    std::string key = MakeTransactionKey(command, transactionID);
    if (_entries.try_emplace(key, Entry{command, {}, now.steady, bLegacyName, digest}).second)
    {
        _order.push_back(std::move(key));
    }
}

void AnswerCache::KeepText(EAcsCommand command, std::string_view transactionID, const std::string& text)
{
    const auto found = _entries.find(MakeTransactionKey(command, transactionID));
    if (found == _entries.end())
    {
        return;
    }
    _bytes += text.size() - found->second.text.size();
    found->second.text = text;
    while (_bytes > _maximumBytes)
    {
        EraseLeastNeeded();
    }
}

void AnswerCache::Forget(Core::Now now)
{
    while (!_order.empty() && _entries.at(_order.front()).receivedAt + _memory < now.steady)
    {
        Erase(_order.begin());
    }
}

void AnswerCache::EraseLeastNeeded()
{
    const auto question = std::find_if(_order.begin(), _order.end(), [this](const std::string& key) {
        const Entry& entry = _entries.at(key);
        return IsQuestion(entry.command) && !entry.text.empty();
    });
    Erase(question == _order.end() ? _order.begin() : question);
}

void AnswerCache::Erase(const std::deque<std::string>::const_iterator& place)
{
    const auto found = _entries.find(*place);
    _bytes -= found->second.text.size();
    _entries.erase(found);
    _order.erase(place);
}

} // namespace ACS::Protocol::Detail

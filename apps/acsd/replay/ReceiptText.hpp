#pragma once

#include <acs/json/JsonFields.hpp>
#include <acs/plan/CommandReceipt.hpp>

#include <cstdint>
#include <string>
#include <tuple>

namespace ACS::Acsd
{

/// A CommandReceipt whose time is counted.
struct ReceiptText
{
    std::string owner;
    std::string key;
    std::string answer;
    std::int64_t time = 0;
};

[[nodiscard]] inline ReceiptText MakeReceiptText(const Planning::CommandReceipt& receipt)
{
    return {receipt.owner, receipt.key, receipt.answer, receipt.time.time_since_epoch().count()};
}

[[nodiscard]] inline Planning::CommandReceipt MakeReceipt(const ReceiptText& text)
{
    return {text.owner, text.key, text.answer, Core::WallTime(Core::WallTime::duration(text.time))};
}

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::ReceiptText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("owner", &Acsd::ReceiptText::owner),
        Required("key", &Acsd::ReceiptText::key),
        Required("answer", &Acsd::ReceiptText::answer),
        Required("time", &Acsd::ReceiptText::time));
};

} // namespace ACS::Json

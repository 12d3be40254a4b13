#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <system_error>

namespace ACS::Sample
{

using DoneHandler = std::function<void(std::error_code)>;

/// What an interface looks like.
class ISampleLink
{
public:
    ISampleLink() = default;
    ISampleLink(const ISampleLink&) = delete;
    ISampleLink& operator=(const ISampleLink&) = delete;
    virtual ~ISampleLink() = default;

    [[nodiscard]] virtual bool ShouldSend(const std::string& text) const = 0;
    virtual void SendAsync(const std::string& text, DoneHandler handler) = 0;
};

/// A receiver of parser events: the names are the parser's, not ours.
class JsonEventCounter final
{
public:
    static constexpr std::chrono::milliseconds DEFAULT_LIMIT{5000};

private:
    std::size_t _count = 0;
    std::atomic<bool> _bStopping = false;
    const std::chrono::milliseconds _limit;

public:
    explicit JsonEventCounter(std::chrono::milliseconds limit = DEFAULT_LIMIT);

    bool Null();
    bool Bool(bool bValue);
    bool Int(int value);
    bool Uint(unsigned value);
    bool Int64(std::int64_t value);
    bool Uint64(std::uint64_t value);
    bool Double(double value);
    bool RawNumber(const char* text, std::size_t length, bool bCopy);
    bool String(const char* text, std::size_t length, bool bCopy);
    bool StartObject();
    bool Key(const char* text, std::size_t length, bool bCopy);
    bool EndObject(std::size_t memberCount);
    bool StartArray();
    bool EndArray(std::size_t elementCount);

    [[nodiscard]] bool IsLongerThan(std::chrono::milliseconds duration) const noexcept;

private:
    bool TryCount();
};

} // namespace ACS::Sample

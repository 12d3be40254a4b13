#pragma once

#include "JournalFile.hpp"
#include <acs/core/Result.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/IOutboxStore.hpp>

#include <fmt/core.h>

#include <cerrno>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

/// Keeps the reports without an Ack in a file: "add SEQUENCE REQUEST" and "ack SEQUENCE" lines. The file only grows; a
/// real store compacts it. Without OpenOrNull nothing is stored, and the reports are lost with the program.
class OutboxFile final : public ACS::Protocol::IOutboxStore
{
    JournalFile _journal;
    bool _bOpen = false;

public:
    /// The requests without an Ack; nullopt if the file cannot be used (see errno).
    [[nodiscard]] std::optional<std::vector<ACS::Protocol::DurableRequest>> OpenOrNull(const std::string& path)
    {
        const std::optional<std::vector<std::string>> lines = _journal.OpenOrNull(path);
        if (!lines.has_value())
        {
            return std::nullopt;
        }
        _bOpen = true;
        ACS::Protocol::AcsCodec codec;
        std::map<std::uint64_t, ACS::Protocol::AcsRequest> requests;
        for (const std::string& line : *lines)
        {
            std::istringstream stream(line);
            std::string verb;
            std::uint64_t sequence = 0;
            std::string text;
            stream >> verb >> sequence >> std::ws;
            std::getline(stream, text);
            if (verb == "ack")
            {
                requests.erase(sequence);
                continue;
            }
            ACS::Protocol::DecodeOutcome outcome = codec.Decode(text);
            if (!outcome.message.has_value() || !std::holds_alternative<ACS::Protocol::AcsRequest>(*outcome.message))
            {
                errno = EBADMSG;
                return std::nullopt;
            }
            requests.insert_or_assign(sequence, std::get<ACS::Protocol::AcsRequest>(std::move(*outcome.message)));
        }
        std::vector<ACS::Protocol::DurableRequest> result;
        result.reserve(requests.size());
        for (auto& [sequence, request] : requests)
        {
            result.push_back({sequence, std::move(request)});
        }
        return result;
    }

    [[nodiscard]] ACS::Core::Result<void> Append(const ACS::Protocol::DurableRequest& request) override
    {
        std::string text;
        ACS::Protocol::AcsCodec::EncodeRequest(request.request, text);
        return Write(fmt::format("add {} {}", request.sequence, text));
    }

    [[nodiscard]] ACS::Core::Result<void> Remove(std::uint64_t sequence) override
    {
        return Write(fmt::format("ack {}", sequence));
    }

private:
    [[nodiscard]] ACS::Core::Result<void> Write(std::string line)
    {
        if (_bOpen && !_journal.TryAppend(std::move(line)))
        {
            const std::error_code error(errno, std::generic_category());
            return ACS::Core::Fail(error, "outbox", "a disk that accepts another line", error.message());
        }
        return {};
    }
};

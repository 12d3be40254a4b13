#include "PostgresResolver.hpp"

#include "PostgresFault.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>

#include <arpa/inet.h>
#include <array>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <netdb.h>
#include <thread>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Between two questions whether to stop.
constexpr std::chrono::milliseconds ASK_INTERVAL{100};

/// Of the time of an attempt, for connecting after the answer: a tenth.
constexpr int LEAST_SHARE = 10;

/// For which an answer that came too late is kept for the next attempt.
constexpr std::chrono::seconds ANSWER_MEMORY{60};

/// One question to the name servers. Its thread may outlive the caller and the program.
class Lookup final
{
    const std::string _host;
    std::mutex _mutex;
    std::condition_variable _answered;
    bool _bDone = false;
    Core::SteadyTime _doneAt{};
    int _error = 0;
    std::vector<std::string> _addresses;

public:
    explicit Lookup(std::string host)
        : _host(std::move(host))
    {
    }

    void Run()
    {
        addrinfo hints{};
        hints.ai_socktype = SOCK_STREAM;
        addrinfo* found = nullptr;
        const int error = ::getaddrinfo(_host.c_str(), nullptr, &hints, &found);
        const std::unique_ptr<addrinfo, void (*)(addrinfo*)> list(error == 0 ? found : nullptr, [](addrinfo* first) {
            if (first != nullptr)
            {
                ::freeaddrinfo(first);
            }
        });
        std::vector<std::string> addresses;
        for (const addrinfo* entry = list.get(); entry != nullptr; entry = entry->ai_next)
        {
            std::array<char, NI_MAXHOST> text{};
            if (::getnameinfo(entry->ai_addr, entry->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST)
                == 0)
            {
                addresses.emplace_back(text.data());
            }
        }
        {
            const std::lock_guard lock(_mutex);
            _error = error;
            _addresses = std::move(addresses);
            _bDone = true;
            _doneAt = std::chrono::steady_clock::now();
        }
        _answered.notify_all();
    }

    /// Whether the answer is there.
    [[nodiscard]] bool TryWait(Core::SteadyTime deadline, const std::function<bool()>& shouldStop)
    {
        std::unique_lock lock(_mutex);
        while (!_bDone && std::chrono::steady_clock::now() < deadline && !(shouldStop && shouldStop()))
        {
            _answered.wait_for(lock, ASK_INTERVAL);
        }
        return _bDone;
    }

    [[nodiscard]] bool IsOutdated()
    {
        const std::lock_guard lock(_mutex);
        return _bDone && std::chrono::steady_clock::now() - _doneAt > ANSWER_MEMORY;
    }

    /// After the answer.
    [[nodiscard]] int GetError() const noexcept
    {
        return _error;
    }

    [[nodiscard]] const std::vector<std::string>& GetAddresses() const noexcept
    {
        return _addresses;
    }
};

/// The questions that are not answered yet, or whose answer was not used: a host is asked for once, however often it is needed
/// meanwhile. Name servers may need longer than each of the attempts to connect.
class PendingLookups final
{
    std::mutex _mutex;
    std::map<std::string, std::shared_ptr<Lookup>> _lookups;

public:
    [[nodiscard]] std::shared_ptr<Lookup> Begin(const std::string& host)
    {
        const std::lock_guard lock(_mutex);
        std::shared_ptr<Lookup>& lookup = _lookups[host];
        if (lookup == nullptr || lookup->IsOutdated())
        {
            lookup = std::make_shared<Lookup>(host);
            std::thread([lookup] { lookup->Run(); }).detach();
        }
        return lookup;
    }

    /// The answer was used.
    void End(const std::string& host, const std::shared_ptr<Lookup>& lookup)
    {
        const std::lock_guard lock(_mutex);
        if (const auto found = _lookups.find(host); found != _lookups.end() && found->second == lookup)
        {
            _lookups.erase(found);
        }
    }
};

/// libpq takes an address without asking a name server. A colon is in IPv6 addresses only, with or without a zone.
bool IsAddress(const std::string& host)
{
    in_addr address{};
    return host.find(':') != std::string::npos || ::inet_pton(AF_INET, host.c_str(), &address) == 1;
}

PendingLookups& GetPendingLookups()
{
    static PendingLookups lookups;
    return lookups;
}

} // namespace

Core::Result<std::vector<std::string>> ResolveHost(
    const std::string& host,
    Core::SteadyTime deadline,
    const std::function<bool()>& shouldStop,
    const std::string& name)
{
    if (host.empty() || host.starts_with('/') || host.starts_with('@') || IsAddress(host))
    {
        return std::vector<std::string>();
    }
    const Core::Duration limit = deadline - std::chrono::steady_clock::now();
    const std::shared_ptr<Lookup> lookup = GetPendingLookups().Begin(host);
    const bool bDone = lookup->TryWait(deadline, shouldStop);
    const Core::Duration left = deadline - std::chrono::steady_clock::now();
    if (bDone
        && left > limit
                / 2) // otherwise connecting may fail for lack of time, and the next attempt needs the answer at once
    {
        GetPendingLookups().End(host, lookup);
    }
    if (!bDone || left < limit / LEAST_SHARE)
    {
        return RefuseStore(
            EPlanningError::StoreFailed,
            name,
            "an answer of the name server; check the network, or give the address of the database server as hostaddr in the URL",
            fmt::format("connecting failed: no answer about the host name {}", host));
    }
    if (lookup->GetError() != 0)
    {
        return RefuseStore(
            EPlanningError::StoreFailed,
            name,
            "a database server that can be reached; check the URL, the network and the server",
            fmt::format(
                "connecting failed: the host name {} has no address: {}",
                host,
                ::gai_strerror(lookup->GetError())));
    }
    return lookup->GetAddresses();
}

} // namespace ACS::Planning

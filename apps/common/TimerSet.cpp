#include "common/TimerSet.hpp"

#include <boost/asio/steady_timer.hpp>

#include <unordered_map>
#include <utility>

namespace ACS::Apps
{

struct TimerSet::Impl : std::enable_shared_from_this<Impl>
{
    /// The run tells a timer from the one that it replaced and whose completion is already on its way.
    struct Entry
    {
        boost::asio::steady_timer timer;
        std::uint64_t run;
    };

    boost::asio::any_io_executor executor;
    Handler handler;
    std::unordered_map<std::uint64_t, Entry> entries;
    std::uint64_t lastRun = 0;

    Impl(const boost::asio::any_io_executor& timerExecutor, Handler handlerToCall)
        : executor(timerExecutor),
          handler(std::move(handlerToCall))
    {
    }

    void Start(std::uint64_t key, Core::Duration delay)
    {
        const std::uint64_t run = ++lastRun;
        entries.erase(key);
        Entry& entry = entries.emplace(key, Entry{boost::asio::steady_timer(executor, delay), run}).first->second;
        entry.timer.async_wait([weak = weak_from_this(), key, run](const boost::system::error_code&) {
            if (const std::shared_ptr<Impl> impl = weak.lock())
            {
                impl->OnExpired(key, run);
            }
        });
    }

    void OnExpired(std::uint64_t key, std::uint64_t run)
    {
        const auto found = entries.find(key);
        if (found == entries.end() || found->second.run != run)
        {
            return;
        }
        entries.erase(found);
        handler(key);
    }
};

TimerSet::TimerSet(const boost::asio::any_io_executor& executor, Handler handler)
    : _impl(std::make_shared<Impl>(executor, std::move(handler)))
{
}

TimerSet::~TimerSet()
{
    _impl->entries.clear();
}

void TimerSet::Start(std::uint64_t key, Core::Duration delay)
{
    _impl->Start(key, delay);
}

void TimerSet::Cancel(std::uint64_t key)
{
    _impl->entries.erase(key);
}

void TimerSet::CancelAll()
{
    _impl->entries.clear();
}

bool TimerSet::IsRunning(std::uint64_t key) const
{
    return _impl->entries.find(key) != _impl->entries.end();
}

} // namespace ACS::Apps

#include "store/StoreWorker.hpp"

#include <utility>

namespace ACS::Acsd
{

StoreWorker::StoreWorker(
    const boost::asio::any_io_executor& executor,
    std::unique_ptr<Planning::IPlanStore> store,
    StoredHandler handler,
    CheckedHandler checkedHandler)
    : _handler(std::move(handler)),
      _checkedHandler(std::move(checkedHandler)),
      _store(executor, std::move(store))
{
}

void StoreWorker::Append(const Planning::StoreBatch& batch)
{
    _store.Do(
        [batch](Planning::IPlanStore& store) { return store.Append(batch); },
        [this](const Core::Result<void>& result) { _handler(result); });
}

void StoreWorker::CheckAsync()
{
    if (std::exchange(_bChecking, true))
    {
        return;
    }
    _store.Do(
        [](Planning::IPlanStore& store) { return store.Check().map([&store] { return store.CheckLog(); }); },
        [this](const Core::Result<Planning::StoreLog>& result) {
            _bChecking = false;
            _checkedHandler(result);
        });
}

} // namespace ACS::Acsd

// file/text: a text in pieces, whose numbers several threads read before they are asked for.
// Depends on piece_parser.h, memory.h, tasks.h.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "memory.h"
#include "piece_parser.h"
#include "tasks.h"

namespace tetstream {

// Who helps, and in what portions.
struct TextThreads {
  const Tasks* tasks = nullptr;  // borrowed; null: nobody
  // Numbers of so many bytes take a tenth of a millisecond; larger ones leave the processor's
  // cache.
  size_t piece_bytes = 128 << 10;
  // More threads find nothing to do: what was read is taken in turn, by one thread.
  size_t most = 8;
};

// Those who help the thread that opened a file whenever that reads.
struct Helpers {
  TextThreads threads;
  std::thread::id thread;
  bool areHere() const;
};

// run() reads the numbers of pieces that wait, on a helper's thread; if it comes late none wait.
class TextPieces final : public Work {
 public:
  // The text's next bytes; fewer than asked for only at the end, or if *fails, when more may come.
  using Read = std::function<size_t(char* out, size_t size, bool* fails)>;

  // Borrows the parser until it is closed.
  TextPieces(const TextThreads& threads, const PieceParser& parser);

  // These by one thread at a time; others are asked to help by that which made this.
  //
  // Takes pieces of what `read` gives while there is room, but one at least, not many more than
  // hold `wanted_bytes`; and has them read.
  void fill(const Read& read, uint64_t wanted_bytes);
  // Whether there is a piece, whose numbers are read then. The first one, until it is dropped.
  bool waitForFirst();
  const uint64_t* numbers() const { return first().numbers.data(); }
  const PieceParser::Found& found() const { return first().found; }
  const char* text() const { return first().text.data(); }
  size_t textBytes() const { return first().size; }
  void dropFirst();
  // The text that was taken, from byte `from` of the first piece on.
  std::vector<char> textFrom(size_t from);
  // Last: waits for who is at work.
  void close() noexcept;

  void run() noexcept override;

 private:
  enum class State { kFree, kWaits, kIsRead, kDone };
  struct Piece {
    explicit Piece(Account& account) : text(account), numbers(account) {}
    Array<char> text;  // with the zeros that the parser wants behind it
    Array<uint64_t> numbers;
    size_t size = 0;  // of the text
    PieceParser::Found found;
    State state = State::kFree;
  };
  using Lock = std::unique_lock<std::mutex>;

  Piece& at(size_t i) { return pieces_[(first_ + i) % pieces_.size()]; }
  const Piece& first() const { return pieces_[first_]; }
  bool takeText(Piece& piece, const Read& read);
  size_t cut(const char* text, size_t size) const;
  void ask();
  // These with the mutex held.
  Piece* nextWaiting();
  void readPiece(Piece& piece, Lock& lock) noexcept;

  const TextThreads threads_;
  const PieceParser& parser_;
  const std::thread::id thread_ = std::this_thread::get_id();
  Account account_;
  std::deque<Piece> pieces_;
  size_t first_ = 0, count_ = 0;  // of those that have text
  std::vector<char> rest_;        // behind the last piece, of the line that was cut
  bool is_over_ = false;          // no piece can follow

  std::mutex mutex_;  // of the pieces' states and of what follows
  std::condition_variable changed_;
  size_t helpers_ = 0;  // asked to come, and here
  bool is_closed_ = false;
};

}  // namespace tetstream

#include "text_pieces.h"

#include <algorithm>
#include <cstring>

#include "plain_number.h"

namespace tetstream {

namespace {

size_t helpersOf(const TextThreads& threads) {
  return std::min(threads.tasks->threads(), threads.most) - 1;
}

}  // namespace

bool Helpers::areHere() const {
  return threads.tasks && threads.tasks->threads() > 1 && std::this_thread::get_id() == thread;
}

// Two pieces for each thread: one that is read and one that waits, or is taken from.
TextPieces::TextPieces(const TextThreads& threads, const PieceParser& parser)
    : threads_(threads), parser_(parser) {
  for (size_t i = 0; i < 2 * (helpersOf(threads) + 1); ++i) pieces_.emplace_back(account_);
}

// The bytes up to where a row may end: a line's end, or in a text of numbers a blank.
size_t TextPieces::cut(const char* text, size_t size) const {
  const bool anywhere = parser_.isCutAtBlanks();
  while (size > 0 && text[size - 1] != '\n' && !(anywhere && isBlank(text[size - 1]))) --size;
  return size;
}

// False: there is none, or no place to cut it.
bool TextPieces::takeText(Piece& piece, const Read& read) {
  const size_t most = threads_.piece_bytes;
  if (piece.text.size() == 0) {
    piece.text.resize(checkedAdd(most, kPlainNumberBytes));
    piece.numbers.resize(parser_.roomFor(most));
  }
  char* const text = piece.text.data();
  const size_t before = rest_.size();
  std::copy(rest_.begin(), rest_.end(), text);
  rest_.clear();
  bool fails = false;
  const size_t size = before + read(text + before, most - before, &fails);
  const bool ends = size < most;
  piece.size = ends && !fails ? size : cut(text, size);
  rest_.assign(text + piece.size, text + size);
  std::memset(text + piece.size, 0, kPlainNumberBytes);
  is_over_ = ends || piece.size == 0;
  return piece.size > 0;
}

void TextPieces::fill(const Read& read, uint64_t wanted_bytes) {
  while (count_ < pieces_.size() && !is_over_) {
    if (count_ > 0 && count_ * threads_.piece_bytes >= wanted_bytes) break;
    Piece& piece = at(count_);
    if (!takeText(piece, read)) break;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      piece.state = State::kWaits;
      ++count_;
    }
    ask();
  }
}

void TextPieces::ask() {
  if (std::this_thread::get_id() != thread_) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (helpers_ == helpersOf(threads_)) return;
    ++helpers_;
  }
  if (threads_.tasks->submit(this)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  --helpers_;
}

TextPieces::Piece* TextPieces::nextWaiting() {
  for (size_t i = 0; i < count_; ++i)
    if (at(i).state == State::kWaits) return &at(i);
  return nullptr;
}

void TextPieces::readPiece(Piece& piece, Lock& lock) noexcept {
  piece.state = State::kIsRead;
  lock.unlock();
  try {
    piece.found = parser_.parse(piece.text.data(), piece.size, piece.numbers.data());
  } catch (...) {  // no memory for a strange word: who reads on from here will say so
    piece.found = {};
  }
  lock.lock();
  piece.state = State::kDone;
  changed_.notify_all();
}

void TextPieces::run() noexcept {
  Lock lock(mutex_);
  while (Piece* piece = is_closed_ ? nullptr : nextWaiting()) readPiece(*piece, lock);
  --helpers_;
}

// While others read the first one, the caller's thread reads those that follow.
bool TextPieces::waitForFirst() {
  if (count_ == 0) return false;
  Lock lock(mutex_);
  while (first().state != State::kDone) {
    if (Piece* piece = nextWaiting())
      readPiece(*piece, lock);
    else
      changed_.wait(lock);
  }
  return true;
}

void TextPieces::dropFirst() {
  const std::lock_guard<std::mutex> lock(mutex_);
  pieces_[first_].state = State::kFree;
  first_ = (first_ + 1) % pieces_.size();
  --count_;
}

std::vector<char> TextPieces::textFrom(size_t from) {
  std::vector<char> text;
  for (size_t i = 0; i < count_; ++i, from = 0) {
    const Piece& piece = at(i);
    text.insert(text.end(), piece.text.data() + from, piece.text.data() + piece.size);
  }
  text.insert(text.end(), rest_.begin(), rest_.end());
  return text;
}

void TextPieces::close() noexcept {
  Lock lock(mutex_);
  is_closed_ = true;
  changed_.wait(lock, [this] {
    return std::none_of(pieces_.begin(), pieces_.end(),
                        [](const Piece& piece) { return piece.state == State::kIsRead; });
  });
  pieces_.clear();
}

}  // namespace tetstream

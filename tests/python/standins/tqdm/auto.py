"""Stands in for tqdm.auto: what a bar is told is kept in `bars`."""
bars = []


class tqdm:
    def __init__(self, total, leave, bar_format):
        self.total, self.bar_format, self.n = total, bar_format, 0
        self.seen, self.phases, self.closed = [], [], False
        bars.append(self)

    def set_description(self, text, refresh=True):
        self.phases.append(text)

    def set_postfix(self, refresh=True, **values):
        self.phases.append(values)

    def refresh(self):
        self.seen.append(self.n)

    def close(self):
        self.closed = True
